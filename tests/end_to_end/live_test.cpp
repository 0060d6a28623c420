// SPDX-License-Identifier: BSD-3-Clause
// Tracking live: the real OpenNI2 runtime in the tool, and a virtual camera that this test holds.
#include <gmock/gmock.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "../capture/virtual_camera.hpp"
#include "block_runs.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/oni_player.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using testing::ContainsRegex;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;

struct Mode {
  int width;
  int frames_per_second;
  float metres_per_unit;
};

std::vector<DepthFrame> frames_of(const std::string& folder) {
  DepthFolderSource source(folder, {});
  std::vector<DepthFrame> frames;
  for (DepthFrame frame; source.next(frame);) frames.push_back(frame);
  return frames;
}

/// The frames forwards and backwards, so that they go on for ever without a jump.
class BlockCamera : public VirtualCamera {
 public:
  BlockCamera(const std::string& folder, const Mode& mode)
      : VirtualCamera(
            [frames = frames_of(folder), mode](std::uint64_t number) {
              const std::uint64_t turn = 2 * (frames.size() - 1);
              const std::uint64_t at = number % turn;
              DepthFrame frame = frames[at < frames.size() ? at : turn - at];
              frame.stamp = static_cast<double>(number) / mode.frames_per_second;
              const float scale = std::round(frame.metres_per_unit / mode.metres_per_unit);
              for (auto& depth : frame.depth)
                depth = static_cast<std::uint16_t>(scale * static_cast<float>(depth));
              frame.metres_per_unit = mode.metres_per_unit;
              return frame;
            },
            mode.frames_per_second, mode.metres_per_unit) {}
};

class Live : public BlockRuns {
 protected:
  static constexpr Mode kUsual{160, 30, 0.001F};

  static std::vector<std::string> watching(const VirtualCamera& camera, const std::string& run,
                                           const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "track",    "--model", "rigid_block",     "--source", "openni2:" + camera.uri(),
        "--output", path(run), "--initial-state", start_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static std::vector<std::string> statuses(const std::string& run) {
    std::vector<std::string> words;
    const auto lines = read_lines(path(run + "/states.csv"));
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::istringstream fields(lines[i]);
      std::string field;
      for (int column = 0; column < 9; ++column) std::getline(fields, field, ',');
      words.push_back(field);
    }
    return words;
  }

  static std::size_t rows(const std::string& run) { return statuses(run).size(); }
};

TEST_F(Live, FollowsInTheModesOfDepthCameras) {
  const std::vector<Mode> modes = {{640, 30, 0.001F}, {320, 60, 0.001F}, {320, 60, 0.0001F}};
  for (const Mode& mode : modes) {
    const std::string name =
        std::to_string(mode.width) + (mode.metres_per_unit < 0.001F ? "tenths" : "");
    write_camera_file(path(name + ".yaml"), mode.width);
    ASSERT_EQ(run_tool({"simulate", "--model", "rigid_block", "--trajectory", "auto", "--frames",
                        "5", "--camera-info", path(name + ".yaml"), "--output", path(name)})
                  .status,
              0);
    const BlockCamera camera(path(name), mode);
    const auto result = run_tool(watching(camera, name + "run", {"--max-frames", "10"}));
    EXPECT_EQ(result.status, 0) << result.errors;
    EXPECT_THAT(statuses(name + "run"), SizeIs(10));
    EXPECT_THAT(statuses(name + "run"), Each("tracking")) << name;
    EXPECT_THAT(read_text(path(name + "run/run.yaml")),
                HasSubstr("width: " + std::to_string(mode.width)));
  }
}

/// A wall in either of two modes: what arrives is checked, not the tracking.
class WallWithModes : public VirtualCamera {
 public:
  WallWithModes()
      : VirtualCamera(
            [](std::uint64_t number, std::size_t mode) {
              DepthFrame frame;
              frame.camera = modes()[mode].camera;
              frame.stamp = static_cast<double>(number) / 30.0;
              frame.metres_per_unit = modes()[mode].metres_per_unit;
              const auto pixels = frame.camera.width * frame.camera.height;
              frame.depth.assign(static_cast<std::size_t>(pixels), 15000);
              return frame;
            },
            modes()) {}

  static std::vector<VirtualMode> modes() {
    return {{{640, 480, 575.0, 575.0, 319.5, 239.5}, 30, 0.001F},
            {{320, 240, 287.5, 287.5, 159.5, 119.5}, 60, 0.0001F}};
  }
};

TEST_F(Live, TakesTheModeThatIsNamed) {
  const WallWithModes camera;
  const auto fast = run_tool(
      watching(camera, "fast", {"--mode", "320x240@60", "--max-frames", "2", "--overwrite"}));
  EXPECT_THAT(fast.errors, HasSubstr(", 320x240@60,100um\n"));
  const auto description = read_text(path("fast/run.yaml"));
  EXPECT_THAT(description, HasSubstr("mode: 320x240@60"));
  EXPECT_THAT(description, HasSubstr("{width: 320, height: 240, fx: 287.5"));

  const auto missing = run_tool(watching(camera, "none", {"--mode", "1280x960@30"}));
  EXPECT_EQ(missing.status, 4);
  EXPECT_THAT(missing.errors, HasSubstr("it offers 640x480@30,1mm 320x240@60,100um"));
  const auto wrong = run_tool(watching(camera, "wrong", {"--mode", "VGA"}));
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors, HasSubstr("give WIDTHxHEIGHT@RATE"));
}

TEST_F(Live, GoesOnWhereTheCameraWasUnpluggedAndCountsWhatItMissed) {
  BlockCamera camera(path("block"), kUsual);
  Tool tool(watching(camera, "away", {"--record", path("away.oni"), "--publish", "stdout"}));
  wait_for_rows("away", 5);
  camera.unplug();
  std::this_thread::sleep_for(300ms);
  const std::size_t before = rows("away");
  std::this_thread::sleep_for(500ms);
  EXPECT_EQ(rows("away"), before) << "a row without a frame";
  camera.plug_in();
  wait_for_rows("away", before + 5);
  tool.send_signal(SIGINT);
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 130) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("was unplugged; waiting for it, 30 s at most"));
  EXPECT_THAT(result.errors, HasSubstr("delivers frames again, after"));
  EXPECT_THAT(result.errors, HasSubstr("1 outage of the device, which came back"));

  EXPECT_EQ(statuses("away").back(), "tracking");
  const auto description = read_text(path("away/run.yaml"));
  EXPECT_THAT(description, HasSubstr("end: signal SIGINT"));
  EXPECT_THAT(description, HasSubstr("total: " + std::to_string(rows("away")) + '\n'));
  EXPECT_THAT(description, HasSubstr("outages: 1"));
  const std::string last_line =
      result.output.substr(result.output.rfind('\n', result.output.size() - 2) + 1);
  const auto last = nlohmann::json::parse(last_line).at("frame").get<std::size_t>();
  EXPECT_THAT(description, HasSubstr("dropped: " + std::to_string(last + 1 - rows("away"))));
  EXPECT_EQ(OniPlayer(path("away.oni")).frame_count(), rows("away"));
}

TEST_F(Live, SaysThatARecordingAloneEndsWhereTheCameraIsUnplugged) {
  BlockCamera camera(path("block"), kUsual);
  Tool tool({"record", "--source", "openni2:" + camera.uri(), "--output", path("alone.oni")});
  while (camera.taken() < 20) std::this_thread::sleep_for(20ms);
  std::this_thread::sleep_for(500ms);
  camera.unplug();
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("was unplugged, and the recording ends there"));
  EXPECT_GT(OniPlayer(path("alone.oni")).frame_count(), 1U);
}

TEST_F(Live, GoesOnWhereTheCameraHasStalled) {
  BlockCamera camera(path("block"), kUsual);
  Tool tool(watching(camera, "stalled"));
  wait_for_rows("stalled", 3);
  camera.stall();
  std::this_thread::sleep_for(1500ms);
  camera.go_on();
  const std::size_t before = rows("stalled");
  wait_for_rows("stalled", before + 3);
  tool.send_signal(SIGTERM);
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 143);
  EXPECT_THAT(result.errors, HasSubstr("has delivered no frame for 1 s; waiting"));
  EXPECT_THAT(result.errors, HasSubstr("delivers frames again"));
  EXPECT_THAT(read_text(path("stalled/run.yaml")), HasSubstr("outages: 1"));
  EXPECT_GT(rows("stalled"), before);
}

TEST_F(Live, FailsWithCompleteFilesWhereTheCameraDoesNotComeBack) {
  BlockCamera camera(path("block"), kUsual);
  Tool tool(watching(camera, "gone", {"--patience", "0.5"}));
  wait_for_rows("gone", 3);
  camera.unplug();
  const auto result = tool.wait();
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.errors, HasSubstr("was unplugged, and did not come back within 0.5 s"));
  const auto description = read_text(path("gone/run.yaml"));
  EXPECT_THAT(description, ContainsRegex("end: .*the device failed"));
  EXPECT_THAT(description, HasSubstr("total: " + std::to_string(rows("gone")) + '\n'));
}

TEST_F(Live, EndsAtOnceAtCtrlCWhereTheCameraIsAway) {
  BlockCamera camera(path("block"), kUsual);
  Tool tool(watching(camera, "left"));
  wait_for_rows("left", 3);
  camera.unplug();
  std::this_thread::sleep_for(500ms);
  const auto signalled = std::chrono::steady_clock::now();
  tool.send_signal(SIGINT);
  EXPECT_EQ(tool.wait().status, 130);
  EXPECT_LT(std::chrono::steady_clock::now() - signalled, 2s);
  EXPECT_THAT(read_text(path("left/run.yaml")), HasSubstr("end: signal SIGINT"));
}

TEST_F(Live, IsTriedAgainByTheSameCommandWhereTheCameraIsGivenBack) {
  BlockCamera camera(path("block"), kUsual);
  for (const std::string run : {"first", "second"}) {
    const auto result = run_tool(watching(camera, run, {"--max-frames", "3"}));
    EXPECT_EQ(result.status, 0) << result.errors;
  }
}

TEST_F(Live, DevicesAreListedWithWhatTheyOffer) {
  const BlockCamera one(path("block"), kUsual);
  const BlockCamera other(path("block"), {160, 60, 0.0001F});
  const auto seen =
      run_tool({"devices"}, {"LOCKBOX_VIRTUAL_DEPTH=" + one.socket() + ':' + other.socket()});
  EXPECT_EQ(seen.status, 0) << seen.errors;
  EXPECT_THAT(seen.output, HasSubstr("openni2:" + one.uri() +
                                     "\n  device: lockbox, Virtual depth camera\n  depth: opens\n"
                                     "  mode: 160x120@30,1mm (taken)\n  focal length: "));
  EXPECT_THAT(seen.output, HasSubstr("openni2:" + other.uri() + '\n'));
  EXPECT_THAT(seen.output, HasSubstr("160x120@60,100um (taken)"));
  const auto named = run_tool({"devices", "--uri", one.uri(), "--uri", "openni2:" + other.uri()});
  EXPECT_EQ(named.status, 0) << named.errors;
  EXPECT_EQ(named.output, seen.output);
}

TEST_F(Live, DevicesThatDoNotOpenSayWhy) {
  BlockCamera camera(path("block"), kUsual);
  const auto uri = camera.uri();
  camera.unplug();
  const auto result = run_tool({"devices", "--uri", uri});
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.output, HasSubstr("openni2:" + uri + "\n"));
  EXPECT_THAT(result.output, ContainsRegex("does not open: .*nobody offers frames at"));
}

TEST(Devices, ThatAreNotThereAreExplained) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"devices"},
        {"track", "--model", "rigid_block", "--source", "openni2:"}}) {
    const auto result = run_tool(arguments);
    EXPECT_EQ(result.status, 4);
    EXPECT_THAT(result.errors, HasSubstr("no OpenNI2 device is connected: no depth camera that "
                                         "OpenNI2 knows is on the USB bus; check the cable"));
    EXPECT_THAT(result.errors, HasSubstr("/openni2/OpenNI2/Drivers)"));
  }
}

TEST(Devices, WithoutDriversAreExplained) {
  // OpenNI2 is there, but the folder beside it that holds its drivers is not.
  const TemporaryFolder folder;
  std::filesystem::create_symlink(LOCKBOX_OPENNI2 "/libOpenNI2.so.0", folder / "libOpenNI2.so.0");
  const auto result = run_tool({"devices"}, {"LD_LIBRARY_PATH=" + folder.path().string(),
                                             "OPENNI2_REDIST=/opt/OpenNI2/Redist"});
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.errors, HasSubstr("OpenNI2 does not start: Found no files matching"));
  EXPECT_THAT(result.errors,
              HasSubstr("must be in " + (folder / "OpenNI2/Drivers").string() + ": install"));
  EXPECT_THAT(result.errors, HasSubstr("OPENNI2_REDIST is set, but"));
}

}  // namespace
}  // namespace lockbox
