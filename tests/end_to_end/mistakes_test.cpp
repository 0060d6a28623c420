// SPDX-License-Identifier: BSD-3-Clause
// What users get wrong most often. Each ends in a message that says what to do.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "camera_file.hpp"
#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "tool.hpp"

namespace lockbox {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kNeverTracked = 5;
constexpr int kWrongInput = 3;

/// A plate with two walls: no turn and no mirror maps it onto itself.
constexpr const char* kCorner = R"(<robot name="corner"><link name="corner">
  <visual><geometry><box size="0.24 0.18 0.03"/></geometry></visual>
  <visual><origin xyz="-0.105 0.02 0.08"/><geometry><box size="0.03 0.14 0.14"/></geometry></visual>
  <visual><origin xyz="0.04 0.075 0.05"/><geometry><box size="0.12 0.03 0.08"/></geometry></visual>
</link></robot>)";
constexpr const char* kOther = R"(<robot name="other"><link name="other"><visual><geometry>
<cylinder radius="0.03" length="0.7"/></geometry></visual></link></robot>)";
constexpr const char* kStates =
    "timestamp,tx,ty,tz,qx,qy,qz,qw\n0,0.01,-0.02,0.7,0.983,0.101,-0.048,0.144\n"
    "0.033,0.012,-0.02,0.7,0.983,0.101,-0.048,0.144\n";

const std::vector<std::string> kOneFrame = {"--max-frames", "1"};

void mirror(DepthFrame& frame) {
  for (auto row = frame.depth.begin(); row != frame.depth.end(); row += frame.camera.width) {
    std::reverse(row, row + frame.camera.width);
  }
}

class Mistake : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder / "corner.urdf", kCorner);
    write_text(folder / "states.csv", kStates);
    write_camera_file(folder / "camera.yaml", 320);
    const auto simulated = run_tool({"simulate", "--model", folder / "corner.urdf", "--trajectory",
                                     folder / "states.csv", "--camera-info", folder / "camera.yaml",
                                     "--output", folder / "images", "--quiet"});
    ASSERT_EQ(simulated.status, 0) << simulated.errors;
  }

  ToolResult track(const std::vector<std::string>& more = {},
                   const std::string& model = "corner.urdf",
                   const std::string& images = "images") const {
    std::vector<std::string> arguments = {"track", "--model", folder / model, "--source",
                                          folder / images};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  }

  /// Changes what is measured.
  void change(const std::function<void(DepthFrame&)>& how,
              const std::string& images = "images") const {
    const auto source = open_source(folder / images);
    DepthFolderWriter changed(folder / "changed");
    for (DepthFrame frame; source->next(frame);) {
      how(frame);
      changed.write(frame);
    }
  }

  TemporaryFolder folder;
};

TEST_F(Mistake, NoneIsFound) {
  const auto result = track();
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_THAT(result.errors, Not(HasSubstr("not found")));
}

TEST_F(Mistake, MeshPath) {
  write_text(folder / "lost.urdf",
             R"(<robot name="a"><link name="a"><visual><geometry>
<mesh filename="meshes/none.stl"/></geometry></visual></link></robot>)");
  const auto result = track({}, "lost.urdf");
  EXPECT_EQ(result.status, kWrongInput);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("lost.urdf:1"), HasSubstr("meshes/none.stl"),
                                   HasSubstr("name the folder that holds it (--package-path)")));
}

TEST_F(Mistake, MeshInMillimetres) {
  write_text(folder / "part.obj",
             "v 0 0 0\nv 200 0 0\nv 0 200 0\nv 0 0 200\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto result = track({}, "part.obj");
  EXPECT_EQ(result.status, kWrongInput);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("millimetres"), HasSubstr("--mesh-scale 0.001")));
}

TEST_F(Mistake, MissingCalibration) {
  std::filesystem::remove(folder / "images/camera_info.yaml");
  const auto result = track();
  EXPECT_EQ(result.status, kWrongInput);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("camera_info.yaml"), HasSubstr("--camera-info")));
}

TEST_F(Mistake, CalibrationOfAnotherSize) {
  write_camera_file(folder / "images/camera_info.yaml", 160);
  const auto result = track();
  EXPECT_EQ(result.status, kWrongInput);
  EXPECT_THAT(result.errors,
              HasSubstr("images are 320x240 but the camera calibration is for 160x120"));
}

TEST_F(Mistake, FocalLengthInMillimetres) {
  std::string text = read_text(folder / "images/camera_info.yaml");
  for (auto at = text.find("288"); at != std::string::npos; at = text.find("288")) {
    text.replace(at, 3, "1.9");
  }
  write_text(folder / "images/camera_info.yaml", text);
  const auto result = track();
  EXPECT_EQ(result.status, kWrongInput);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("focal length"), HasSubstr("millimetres")));
}

/// So narrow a view that it is taken, and doubted where nothing is found.
TEST_F(Mistake, FocalLengthOfAnotherCamera) {
  change([](DepthFrame& frame) { frame.camera.fx = frame.camera.fy = 2400.0; });
  const auto result = track(kOneFrame, "corner.urdf", "changed");
  EXPECT_EQ(result.status, kNeverTracked);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("By its focal length the camera sees 7.6 degrees"),
                                   HasSubstr("--camera-info")));
}

TEST_F(Mistake, DepthScale) {
  const auto result = track({"--depth-scale", "100"});
  EXPECT_EQ(result.status, kNeverTracked);
  EXPECT_THAT(result.errors,
              AllOf(HasSubstr("farther than 5 m"), HasSubstr("try --depth-scale 1000")));
}

TEST_F(Mistake, MirroredImage) {
  change(mirror);
  const auto result = track({}, "corner.urdf", "changed");
  EXPECT_EQ(result.status, kNeverTracked);
  constexpr auto kTold = "found in the mirror image of the frame: switch mirroring off";
  EXPECT_THAT(result.errors, HasSubstr(kTold));
  const auto at_end = result.errors.find("in any of 2 frames");
  ASSERT_NE(at_end, std::string::npos) << result.errors;
  EXPECT_THAT(result.errors.substr(at_end), HasSubstr(kTold));
}

/// Upside down, the cabinet fits the mirrored image convincingly, but for one of its drawers.
TEST_F(Mistake, MirroredImageInWhichSomethingIsFound) {
  const auto simulated =
      run_tool({"simulate", "--model", "cabinet", "--trajectory", "auto", "--frames", "1",
                "--scene", "room", "--output", folder / "room", "--quiet"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  change(mirror, "room");
  const auto result = run_tool({"track", "--model", "cabinet", "--source", folder / "changed"});
  EXPECT_EQ(result.status, kNeverTracked);
  EXPECT_THAT(result.errors, HasSubstr("found in the mirror image of the frame"));
}

/// Mirrored, the frame would fit hardly less well than as it is.
TEST_F(Mistake, PrincipalPointOfACroppedImage) {
  const auto simulated = run_tool({"simulate", "--model", "cabinet", "--trajectory", "auto",
                                   "--frames", "1", "--scene", "room", "--camera-info",
                                   folder / "camera.yaml", "--output", folder / "room", "--quiet"});
  ASSERT_EQ(simulated.status, 0) << simulated.errors;
  std::string text = read_text(folder / "room/camera_info.yaml");
  text.replace(text.find("159.5"), 5, "99.5");
  write_text(folder / "room/camera_info.yaml", text);
  const auto result = run_tool({"track", "--model", "cabinet", "--source", folder / "room"});
  EXPECT_EQ(result.status, kNeverTracked);
  EXPECT_THAT(
      result.errors,
      AllOf(HasSubstr("cx 99.5, cy 119.5 (--camera-info), where the image's middle is 159.5"),
            Not(HasSubstr("mirror"))));
  const std::string said = "the object was not found for certain";
  EXPECT_EQ(result.errors.find(said), result.errors.rfind(said)) << "once is enough";
  EXPECT_THAT(result.errors, HasSubstr(said + " up to frame 0:\n  The likeliest place"));
}

/// As a camera that hangs upside down sees it: that is no mistake.
TEST_F(Mistake, TurnedImageIsNone) {
  change([](DepthFrame& frame) { std::reverse(frame.depth.begin(), frame.depth.end()); });
  EXPECT_EQ(track({}, "corner.urdf", "changed").status, 0);
}

TEST_F(Mistake, ImageTurnedWithoutItsCalibration) {
  const std::string file = folder / "images/camera_info.yaml";
  std::string text = read_text(file);
  text.replace(text.find("image_width: 320"), 16, "image_width: 240");
  text.replace(text.find("image_height: 240"), 17, "image_height: 320");
  write_text(file, text);
  const auto result = track();
  EXPECT_EQ(result.status, kWrongInput);
  EXPECT_THAT(result.errors, HasSubstr("width and height are exchanged in the calibration"));
}

TEST_F(Mistake, ObjectOutOfView) {
  change([](DepthFrame& frame) { std::fill(frame.depth.begin(), frame.depth.end(), 1500); });
  const auto result = track(kOneFrame, "corner.urdf", "changed");
  EXPECT_EQ(result.status, kNeverTracked);
  EXPECT_THAT(result.errors, HasSubstr("is it in view, between 0.2 and 5 m from the camera?"));
}

TEST_F(Mistake, WrongModel) {
  write_text(folder / "other.urdf", kOther);
  const auto inspected = run_tool({"inspect", "--model", folder / "other.urdf"}).output;
  EXPECT_THAT(inspected, testing::ContainsRegex("other +60\\.00 +60\\.00 +700\\.00\n"));
  const auto result = track(kOneFrame, "other.urdf");
  EXPECT_EQ(result.status, kNeverTracked);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("check these"), HasSubstr("is it this object"),
                                   HasSubstr("0.71 m across"), HasSubstr("lockbox inspect")));
}

TEST_F(Mistake, SensorThatErrsLess) {
  write_text(folder / "other.urdf", kOther);
  const auto result = track({"--max-frames", "1", "--sensor", "ideal"}, "other.urdf");
  EXPECT_THAT(result.errors, AllOf(HasSubstr("sensor: depths err by"), HasSubstr("--sensor auto")));
}

}  // namespace
}  // namespace lockbox
