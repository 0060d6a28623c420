// SPDX-License-Identifier: BSD-3-Clause
// The 3D viewer on a real (virtual) X display.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "viewed_run.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

/// An X server of its own, to be ended while windows are open on it.
class DoomedServer {
 public:
  explicit DoomedServer(const std::string& options = "")
      : output_(
            popen(("echo $$; exec Xvfb -displayfd 1 " + options + " 2>/dev/null").c_str(), "r")) {
    if (fscanf(output_, "%d %d", &process_, &number_) != 2) number_ = -1;
  }
  ~DoomedServer() {
    end();
    pclose(output_);
  }
  DoomedServer(const DoomedServer&) = delete;
  DoomedServer& operator=(const DoomedServer&) = delete;

  bool is_running() const { return number_ >= 0; }
  std::string display() const { return ":" + std::to_string(number_); }
  void end() const { kill(process_, SIGKILL); }

 private:
  FILE* output_;
  int process_ = -1;
  int number_ = -1;
};

TEST_F(View, OfARunChangesNothingInItsResults) {
  const auto viewed = track("viewed", {"--view"});
  ASSERT_EQ(viewed.status, 0) << viewed.errors;
  const auto rows = rows_without_latency(path("viewed/states.csv"));
  ASSERT_THAT(rows, SizeIs(kFrames + 1));
  EXPECT_EQ(rows, rows_without_latency(path("run/states.csv")));
  EXPECT_EQ(read_text(path("viewed/base.tum")), read_text(path("run/base.tum")));
}

TEST_F(View, OfARunEndsAloneWhenItsWindowIsClosed) {
  Tool tool(tracking("closed", {"--view", "--realtime"}));
  user_->find_window("lockbox");
  user_->close();
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(read_text(path("closed/run.yaml")), HasSubstr("end: end of the source"));
}

TEST_F(View, OfARunEndsAloneWhenTheDisplayIsLost) {
  const DoomedServer server;
  if (!server.is_running()) GTEST_SKIP() << "no Xvfb";
  Tool tool(tracking("lost_display", {"--view", "--realtime"}), {"DISPLAY=" + server.display()});
  XUser(server.display()).find_window("lockbox");
  server.end();
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(read_text(path("lost_display/run.yaml")), HasSubstr("end: end of the source"));
}

/// A display that nobody has given the resource Xft.dpi.
TEST_F(View, IsAsLargeAsTheDotsPerInchOfItsScreenWant) {
  const DoomedServer server("-screen 0 2560x1440x24 -dpi 192");
  if (!server.is_running()) GTEST_SKIP() << "no Xvfb";
  Tool tool({"view", "--model", "rigid_block"}, {"DISPLAY=" + server.display()});
  XUser user(server.display());
  user.find_window("lockbox");
  EXPECT_THAT(user.picture(), SizeIs(3 * 2560 * 1440)) << "twice as large, as far as it fits";
  user.press("q");
  EXPECT_EQ(tool.wait().status, 0);
}

TEST_F(View, IsRefusedWhereThereIsNoDisplay) {
  for (const std::string display : {"", ":4095"}) {
    const std::vector<std::string> environment = {"DISPLAY=" + display};
    const auto view = run_tool(viewing({}), environment);
    const auto run = track("never", {"--view"}, environment);
    for (const auto& result : {view, run}) {
      EXPECT_EQ(result.status, 3);
      EXPECT_THAT(result.errors, HasSubstr("view --screenshot"));
    }
  }
  EXPECT_FALSE(std::filesystem::exists(path("never"))) << "nothing is begun";
}

TEST_F(View, DrawsPicturesWhereThereIsNoDisplay) {
  const auto result = run_tool(viewing({"--screenshot", path("drawn.png")}), {"DISPLAY="});
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_TRUE(std::filesystem::exists(path("drawn.png")));
}

/// Waits, at most some seconds, until the window shows something else to the right of the sliders.
bool changes_beside_sliders(const XUser& user, const std::vector<unsigned char>& before,
                            int width) {
  for (int waits = 0; waits < 200; ++waits) {
    const auto now = user.picture();
    for (std::size_t i = 0; i < now.size(); ++i) {
      const std::size_t column = i / 3 % static_cast<std::size_t>(width);
      if (column > static_cast<std::size_t>(width) / 3 && now[i] != before[i]) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

TEST_F(View, OfAModelAloneHasSlidersThatMoveItsJoints) {
  constexpr int kWidth = 640;
  Tool tool({"view", "--model", "cabinet", "--size", "640x480"});
  user_->find_window("lockbox");
  EXPECT_EQ(user_->title(), "lockbox - cabinet");
  const auto pause = [] { std::this_thread::sleep_for(std::chrono::milliseconds(700)); };
  pause();
  const auto before = user_->picture();
  // The first slider's handle: its joint stands at its lower limit.
  const int x = 21;
  const int y = 58;
  user_->point(x, y);
  pause();
  user_->press_button(x, y);
  pause();
  user_->point(120, y);
  pause();
  user_->release_button(120, y);
  EXPECT_TRUE(changes_beside_sliders(*user_, before, kWidth));
  user_->press("q");
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST_F(View, PlaysUntilItsWindowIsClosedOrInterrupted) {
  for (const bool by_signal : {true, false}) {
    Tool tool(viewing({}));
    user_->find_window("lockbox - rigid_block - " + path("run/states.csv"));
    for (const auto* key : {"End", "Left", "Home", "h", "minus", "space", "e", "b", "t", "u", "s",
                            "m", "p", "r", "h"})
      user_->press(key);
    if (by_signal) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      tool.send_signal(SIGINT);
    } else {
      user_->press("q");
    }
    const auto result = tool.wait();
    EXPECT_EQ(result.status, by_signal ? 130 : 0) << result.errors;
  }
}

}  // namespace
}  // namespace lockbox
