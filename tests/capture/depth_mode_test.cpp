// SPDX-License-Identifier: BSD-3-Clause
// Modes of cameras: how they are written, and those of a device of the real OpenNI2 runtime.
#include "lockbox/capture/depth_mode.hpp"

#include <gmock/gmock.h>

#include "lockbox/capture/device_list.hpp"
#include "lockbox/capture/live_device.hpp"
#include "lockbox/capture/oni_player.hpp"
#include "lockbox/capture/oni_writer.hpp"
#include "synthetic_frames.hpp"
#include "virtual_camera.hpp"

namespace lockbox {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(DepthModeText, IsReadWithAndWithoutTheUnit) {
  const WantedMode plain = parse_depth_mode("640x480@30");
  EXPECT_EQ(plain.width, 640);
  EXPECT_EQ(plain.height, 480);
  EXPECT_EQ(plain.frames_per_second, 30);
  EXPECT_EQ(plain.metres_per_unit, std::nullopt);
  EXPECT_EQ(parse_depth_mode("320x240@60,1mm").metres_per_unit, 0.001);
  EXPECT_EQ(parse_depth_mode("320x240@60,100um").metres_per_unit, 0.0001);
}

TEST(DepthModeText, IsWrittenAsItIsRead) {
  EXPECT_EQ(to_string(DepthMode{640, 480, 30, 0.001}), "640x480@30,1mm");
  for (const std::string text : {"640x480@30", "320x240@60,1mm", "320x240@60,100um"}) {
    EXPECT_EQ(to_string(parse_depth_mode(text)), text);
  }
}

TEST(DepthModeText, ThatIsNoneIsRefusedWithExamples) {
  for (const std::string text : {"", "640", "640x480", "640x480@", "x480@30", "0x480@30",
                                 "640x-480@30", "640x480@30,", "640x480@30,1cm", "640x480@30 "}) {
    EXPECT_THAT([&] { parse_depth_mode(text); },
                ThrowsMessage<InputError>(HasSubstr("such as 640x480@30 or 320x240@60,100um")))
        << text;
  }
}

/// As depth cameras are, only smaller: a large mode, a fast one, and each in both units.
class CameraWithModes : public VirtualCamera {
 public:
  CameraWithModes()
      : VirtualCamera([](std::uint64_t number, std::size_t mode) { return seen(number, mode); },
                      modes()) {}

  static DepthFrame seen(std::uint64_t number, std::size_t mode) {
    DepthFrame frame = synthetic_frame(number, modes()[mode].camera);
    frame.metres_per_unit = modes()[mode].metres_per_unit;
    return frame;
  }

 private:
  static std::vector<VirtualMode> modes() {
    const PinholeCamera large{640, 480, 575.0, 575.0, 319.5, 239.5};
    const PinholeCamera small{320, 240, 287.5, 287.5, 159.5, 119.5};
    return {{large, 30, 0.0001F}, {small, 60, 0.001F}, {small, 60, 0.0001F}, {large, 30, 0.001F}};
  }
};

/// The first frame in this mode, which must be the camera's of the given number.
DepthFrame frame_in(const CameraWithModes& camera, const std::string& mode, std::size_t number) {
  SourceOptions options;
  if (!mode.empty()) options.mode = parse_depth_mode(mode);
  LiveDevice device(camera.uri(), options);
  DepthFrame frame;
  EXPECT_TRUE(device.next(frame)) << mode;
  const auto index = static_cast<std::uint64_t>(std::llround(frame.stamp / 0.033333));
  const DepthFrame expected = CameraWithModes::seen(index, number);
  EXPECT_EQ(frame.depth, expected.depth) << mode;
  EXPECT_EQ(frame.camera, expected.camera) << mode;
  EXPECT_EQ(frame.metres_per_unit, expected.metres_per_unit) << mode;
  EXPECT_THAT(device.description(), HasSubstr(", " + std::to_string(frame.camera.width) + "x"));
  return frame;
}

TEST(DepthModes, AreTakenAsWanted) {
  const CameraWithModes camera;
  frame_in(camera, "640x480@30", 3);  // of the two units the millimetre
  frame_in(camera, "320x240@60,100um", 2);
  frame_in(camera, "320x240@60", 1);
  frame_in(camera, "640x480@30,100um", 0);
  frame_in(camera, "", 3);
}

TEST(DepthModes, AreListedWithTheOneThatIsTakenUnasked) {
  const CameraWithModes camera;
  const ListedDevice device = list_devices({camera.uri()}).back();
  ASSERT_EQ(device.problem, std::nullopt);
  EXPECT_THAT(device.modes,
              ElementsAre(DepthMode{640, 480, 30, 1e-4}, DepthMode{320, 240, 60, 1e-3},
                          DepthMode{320, 240, 60, 1e-4}, DepthMode{640, 480, 30, 1e-3}));
  EXPECT_EQ(device.chosen, device.modes.back());
}

TEST(DepthModes, ThatAreNotOfferedAreAnsweredWithThoseThatAre) {
  const CameraWithModes camera;
  for (const std::string mode : {"800x600@30", "640x480@60"}) {
    EXPECT_THAT([&] { frame_in(camera, mode, 0); },
                ThrowsMessage<DeviceError>(HasSubstr(
                    "does not offer the mode " + mode +
                    " (--mode); it offers 640x480@30,100um 320x240@60,1mm 320x240@60,100um")));
  }
}

TEST(DepthModes, AreTheSameWhenTheCameraComesBack) {
  CameraWithModes camera;
  SourceOptions options;
  options.mode = parse_depth_mode("320x240@60,100um");
  options.patience = LOCKBOX_SLOWDOWN * 10.0;
  LiveDevice device(camera.uri(), options);
  DepthFrame frame;
  ASSERT_TRUE(device.next(frame));
  camera.unplug();
  camera.plug_in();
  while (device.faults().outages == 0) ASSERT_TRUE(device.next(frame));
  EXPECT_EQ(frame.camera.width, 320);
  EXPECT_FLOAT_EQ(frame.metres_per_unit, 0.0001F);
}

TEST(DepthModes, AreRecorded) {
  const TemporaryFolder folder;
  const CameraWithModes camera;
  SourceOptions options;
  options.mode = parse_depth_mode("320x240@60,100um");
  record("openni2:" + camera.uri(), folder / "a.oni", {[&camera] { return camera.taken() > 60; }},
         options);
  OniPlayer player(folder / "a.oni");
  DepthFrame frame;
  ASSERT_TRUE(player.next(frame));
  EXPECT_EQ(frame.camera.width, 320);
  EXPECT_FLOAT_EQ(frame.metres_per_unit, 0.0001F);
}

TEST(DepthModes, AreNotForRecordings) {
  const TemporaryFolder folder;
  OniWriter writer(folder / "a.oni", small_camera(), 30);
  writer.write(synthetic_frame(0));
  writer.finish();
  std::vector<std::string> told;
  SourceOptions options;
  options.mode = parse_depth_mode("320x240@60");
  options.warn = [&told](const std::string& text) { told.push_back(text); };
  open_source(folder / "a.oni", options);
  EXPECT_THAT(told, ElementsAre(HasSubstr("--mode")));
}

}  // namespace
}  // namespace lockbox
