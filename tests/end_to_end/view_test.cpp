// SPDX-License-Identifier: BSD-3-Clause
// The 3D viewer on a real (virtual) X display.
#include <gmock/gmock.h>
#include <png.h>
#include <signal.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <thread>

#include "../visualization/x_user.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

constexpr std::size_t kFrames = 30;

class View : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    user_ = std::make_unique<XUser>();
    simulated_ = run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames",
                           std::to_string(kFrames), "--output", path("block.oni")});
    tracked_ = track("run");
  }
  static void TearDownTestSuite() {
    user_.reset();
    folder_.reset();
  }

  void SetUp() override {
    if (!user_->is_connected()) GTEST_SKIP() << "no display";
    ASSERT_EQ(simulated_.status, 0) << simulated_.errors;
    ASSERT_EQ(tracked_.status, 0) << tracked_.errors;
  }

  static std::string path(const std::string& name) { return (*folder_ / name).string(); }

  static std::vector<std::string> tracking(const std::string& run,
                                           const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "track",           "--model",         "rigid_block",           "--source",
        path("block.oni"), "--initial-state", path("groundtruth.csv"), "--output",
        path(run)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  static ToolResult track(const std::string& run, const std::vector<std::string>& more = {},
                          const std::vector<std::string>& environment = {}) {
    return run_tool(tracking(run, more), environment);
  }

  static std::vector<std::string> viewing(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"view",
                                          "--model",
                                          "rigid_block",
                                          "--source",
                                          path("block.oni"),
                                          "--states",
                                          path("run/states.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static std::unique_ptr<TemporaryFolder> folder_;
  static std::unique_ptr<XUser> user_;
  static ToolResult simulated_;
  static ToolResult tracked_;
};

std::unique_ptr<TemporaryFolder> View::folder_;
std::unique_ptr<XUser> View::user_;
ToolResult View::simulated_;
ToolResult View::tracked_;

/// An X server of its own, to be ended while windows are open on it.
class DoomedServer {
 public:
  DoomedServer() : output_(popen("echo $$; exec Xvfb -displayfd 1 2>/dev/null", "r")) {
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

/// Colours of a picture, three bytes a pixel.
std::vector<std::uint8_t> read_png(const std::string& file) {
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&header, file.c_str()) == 0) return {};
  header.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(header));
  png_image_finish_read(&header, nullptr, rgb.data(), 0, nullptr);
  return rgb;
}

/// Share of pixels of which the predicate holds.
template <typename Predicate>
double share_of(const std::vector<std::uint8_t>& rgb, Predicate&& predicate) {
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    count += predicate(int{rgb[i]}, int{rgb[i + 1]}, int{rgb[i + 2]}) ? 1 : 0;
  }
  return 3.0 * static_cast<double>(count) / static_cast<double>(rgb.size());
}

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

TEST_F(View, IsRefusedWhereThereIsNoDisplay) {
  for (const std::string display : {"", ":4095"}) {
    const std::vector<std::string> environment = {"DISPLAY=" + display};
    const auto view = run_tool(viewing({"--screenshot", path("never.png")}), environment);
    const auto run = track("never", {"--view"}, environment);
    for (const auto& result : {view, run}) {
      EXPECT_EQ(result.status, 3);
      EXPECT_THAT(result.errors, HasSubstr("xvfb-run"));
    }
  }
  EXPECT_FALSE(std::filesystem::exists(path("never.png")));
  EXPECT_FALSE(std::filesystem::exists(path("never"))) << "nothing is begun";
}

TEST_F(View, DrawsTheModelInItsColorsIntoAPicture) {
  const auto file = path("model.png");
  const auto result =
      run_tool({"view", "--model", "rigid_block", "--screenshot", file, "--size", "320x240"});
  ASSERT_EQ(result.status, 0) << result.errors;
  const auto picture = read_png(file);
  ASSERT_THAT(picture, SizeIs(3 * 320 * 240));
  // The block's material is a warm colour; the background is bluish.
  const double block = share_of(picture, [](int r, int, int b) { return r > b + 30; });
  EXPECT_GT(block, 0.05);
  EXPECT_LT(block, 0.9);
}

TEST_F(View, DrawsTheErrorsOfAFrame) {
  ASSERT_EQ(run_tool(viewing({"--frame", "7", "--screenshot", path("plain.png")})).status, 0);
  ASSERT_EQ(
      run_tool(viewing({"--frame", "7", "--errors", "--screenshot", path("errors.png")})).status,
      0);
  const auto is_blue = [](int r, int, int b) { return b > 150 && b > r + 40; };
  const auto is_red = [](int r, int g, int b) { return r > 150 && r > g + 40 && r > b + 40; };
  const auto plain = read_png(path("plain.png"));
  const auto errors = read_png(path("errors.png"));
  EXPECT_LT(share_of(plain, is_blue), 1e-3);
  EXPECT_GT(share_of(errors, is_blue), 5e-3);
  EXPECT_GT(share_of(errors, is_red), 5e-3);
}

TEST_F(View, RefusesFramesThatAreNotThere) {
  const auto result = run_tool(viewing({"--frame", "30", "--screenshot", path("beyond.png")}));
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.errors, HasSubstr("30 frames"));
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
    user_->find_window("lockbox");
    for (const auto* key : {"End", "Left", "Home", "h", "minus", "space", "e", "m", "p", "r", "h"})
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
