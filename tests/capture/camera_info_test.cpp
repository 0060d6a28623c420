// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/camera_info.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lockbox/capture/depth_folder.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "temporary_folder.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

constexpr char kImageSize[] = "image_width: 640\nimage_height: 480\n";

CameraCalibration read(const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / "camera.yaml", text);
  return read_camera_info(folder / "camera.yaml");
}

const PinholeCamera kExpectedCamera{640, 480, 525.5, 526.0, 319.5, 239.0};

TEST(CameraInfo, MessagesOfBothGenerationsOfRosAreRead) {
  const std::string head =
      "header:\n  seq: 3\n  stamp: {secs: 12, nsecs: 5}\n  frame_id: \"camera\"\n"
      "height: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\n";
  const CameraCalibration one = read(
      head +
      "D: [0.1, -0.2, 0.0, 0.0, 0.3]\nK: [525.5, 0.0, 319.5, 0.0, 526.0, 239.0, 0.0, 0.0, 1.0]\n"
      "R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\nbinning_x: 0\nbinning_y: 0\n"
      "roi: \n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n  do_rectify: False\n---\n");
  EXPECT_EQ(one.camera, kExpectedCamera);
  EXPECT_THAT(one.distortion, ElementsAre(0.1, -0.2, 0.0, 0.0, 0.3));
  const std::string message =
      head +
      "d:\n- 0.0\n- 0.0\nk:\n- 525.5\n- 0.0\n- 319.5\n- 0.0\n- 526.0\n- 239.0\n- 0.0\n"
      "- 0.0\n- 1.0\n---\n";
  const CameraCalibration two = read(message + message + "height: [broken\n");
  EXPECT_EQ(two.camera, kExpectedCamera);
  EXPECT_FALSE(two.has_distortion());
}

TEST(CameraInfo, BinnedAndCutOutImagesHaveTheirOwnCamera) {
  const CameraCalibration calibration = read(
      "width: 1280\nheight: 960\nk: [1000, 0, 640, 0, 1000, 480, 0, 0, 1]\nbinning_x: 2\n"
      "binning_y: 2\nroi: {x_offset: 40, y_offset: 20, height: 800, width: 1200}\n");
  EXPECT_EQ(calibration.camera, (PinholeCamera{600, 400, 500, 500, 300, 230}));
}

TEST(CameraInfo, OpenCvsOwnFilesAreRead) {
  const CameraCalibration calibration = read(
      std::string("%YAML:1.0\n---\n") + kImageSize +
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 525.5, 0., "
      "319.5, 0., 526., 239., 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 8\n   cols: 1\n   dt: d\n   data: [ 0.1, "
      "0., 0., 0., 0., 0., 0., 0.2 ]\n");
  EXPECT_EQ(calibration.camera, kExpectedCamera);
  EXPECT_THAT(calibration.distortion, ElementsAre(0.1, 0, 0, 0, 0, 0, 0, 0.2));
}

TEST(CameraInfo, CoefficientsThatAModelDoesNotHaveMayBeZero) {
  const std::string sound =
      std::string(kImageSize) + "camera_matrix: {data: [525, 0, 320, 0, 525, 240, 0, 0, 1]}\n";
  for (const char* const list : {"[1e-6, 0, 0, 0]", "[1e-6, 0, 0, 0, 0, 0, 0, 0]",
                                 "[1e-6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]"}) {
    EXPECT_THAT(
        read(sound + "distortion_model: plumb_bob\ndistortion_coefficients: {data: " + list + "}\n")
            .distortion,
        ElementsAre(1e-6, 0, 0, 0, 0))
        << list;
  }
  EXPECT_THAT(read(sound + "distortion_model: rational_polynomial\n"
                           "distortion_coefficients: [1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0]\n")
                  .distortion,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(read(sound + "distortion_model: ''\nD: []\n").distortion, IsEmpty());
}

TEST(CameraInfo, FocalLengthsInOtherUnitsAreRefusedWithTheFactor) {
  const auto refusal = [](const std::string& matrix) {
    try {
      read(kImageSize + ("camera_matrix: [" + matrix + ", 0, 0, 1]\n"));
      return std::string("read");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(refusal("0.82, 0, 0.5, 0, 1.09, 0.5"),
              AllOf(HasSubstr(":3: "), HasSubstr("by the width, 640")));
  EXPECT_THAT(refusal("3.6, 0, 319.5, 0, 3.6, 239.5"), HasSubstr("millimetres"));
  EXPECT_THAT(refusal("36000, 0, 319.5, 0, 36000, 239.5"), HasSubstr("micrometres"));
  EXPECT_THAT(refusal("1e12, 0, 319.5, 0, 525, 239.5"), HasSubstr("times as high as wide"));
  EXPECT_THAT(refusal("525, 0, 319.5, 0, 5256, 239.5"), HasSubstr("times as wide as high"));
  EXPECT_EQ(refusal("525, 0, 319.5, 0, 2100, 239.5"), "read") << "four rows may be one";
  EXPECT_EQ(refusal("525, 0, 319.5, 0, 525, 239.5"), "read");
}

TEST(CameraInfo, PrincipalPointsThatNoCutOutHasAreRefused) {
  const auto read_with = [](const std::string& cx, const std::string& cy) {
    read(kImageSize + ("camera_matrix: [525, 0, " + cx + ", 0, 525, " + cy + ", 0, 0, 1]\n"));
  };
  for (const std::string far : {"9223372036854775807", "-1e300", "1e4", "-1e4"}) {
    EXPECT_THAT([&] { read_with(far, "239.5"); },
                ThrowsMessage<InputError>(HasSubstr("no camera sees so far")));
    EXPECT_THAT([&] { read_with("319.5", far); },
                ThrowsMessage<InputError>(HasSubstr("no camera sees so far")));
  }
  EXPECT_NO_THROW(read_with("-640", "960"));
}

TEST(CameraInfo, AMatrixOfAnotherResolutionIsToldWithTheFactor) {
  const TemporaryFolder folder;
  DepthFolderWriter(folder / "sequence").write(synthetic_frame(0));
  const auto warnings = [&folder](const PinholeCamera& camera) {
    write_camera_info(folder / "sequence" / "camera_info.yaml",
                      {.camera = camera, .distortion = {}, .depth_scale = {}});
    std::vector<std::string> texts;
    SourceOptions options;
    options.warn = [&texts](const std::string& text) { texts.push_back(text); };
    const DepthFolderSource source(folder / "sequence", options);
    return texts;
  };
  EXPECT_THAT(warnings({160, 120, 288, 288, 159.5, 119.5}), ElementsAre(HasSubstr("by 0.5")));
  EXPECT_THAT(warnings({160, 120, 72, 72, 39.5, 29.5}), ElementsAre(HasSubstr("by 2")));
  EXPECT_THAT(warnings({160, 120, 144, 144, 10, 59.5}), ElementsAre(HasSubstr("cut out")));
  EXPECT_THAT(warnings({160, 120, 144, 144, 85, 56}), IsEmpty());
}

TEST(CameraInfo, NumbersComeBackExactly) {
  const TemporaryFolder folder;
  const CameraCalibration written{
      .camera = {640, 480, 607.178466796875, 1801.0 / 3.0, 319.1, 240.1},
      .distortion = {0.1, -0.2, 1e-9, 0.0, 5.5},
      .depth_scale = 5000.0};
  write_camera_info(folder / "camera_info.yaml", written);
  const CameraCalibration read = read_camera_info(folder / "camera_info.yaml");
  EXPECT_EQ(read.camera, written.camera);
  EXPECT_EQ(read.distortion, written.distortion);
  EXPECT_EQ(read.depth_scale, written.depth_scale);
}

TEST(CameraInfo, EquidistantSurvivesARoundTripAndBendsWithoutCoefficients) {
  const TemporaryFolder folder;
  const CameraCalibration written{.camera = {640, 480, 400.0, 400.0, 319.5, 239.5},
                                  .distortion = {0.0, 0.0, 0.0, 0.0},
                                  .depth_scale = {},
                                  .is_equidistant = true};
  write_camera_info(folder / "camera_info.yaml", written);
  const CameraCalibration read = read_camera_info(folder / "camera_info.yaml");
  EXPECT_TRUE(read.is_equidistant);
  EXPECT_TRUE(read.has_distortion());
  EXPECT_EQ(read.distortion, written.distortion);
}

TEST(CameraInfo, ProblemsNameTheLine) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "camera_info.yaml";
  const std::string sound =
      "image_width: 640\nimage_height: 480\n"
      "camera_matrix: {rows: 3, cols: 3, data: [500, 0, 320, 0, 500, 240, 0, 0, 1]}\n";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"image_width: 640\nimage_height: -1\ncamera_matrix: {data: [500, 0, 320, 0, 500, 240, 0, 0, "
       "1]}\n",
       ":2: image_height is not a size"},
      {"image_width: 640\nimage_height: 480\n", "camera_matrix is missing"},
      {"image_width: 640\nimage_height: 480\ncamera_matrix: {data: [5, 0]}\n", ":3: camera_matrix"},
      {sound + "depth_scale: 0\n", ":4: depth_scale must be positive"},
      {sound + "depth_scale: 1,5\n", ":4: depth_scale is not a number"},
      {sound + "distortion_model: thin_prism\ndistortion_coefficients: {data: [1, 0, 0, 0]}\n",
       ":4: distortion model thin_prism is not supported"},
      {sound + "distortion_coefficients: {data: [1, 0]}\n", ":4: plumb_bob needs 5"},
      {sound + "distortion_model: equidistant\ndistortion_coefficients: {data: [0, 0, 0]}\n",
       ":5: equidistant needs 4 coefficients, found 3"},
      {sound + "distortion_model: equidistant\n", ":4: equidistant needs 4 coefficients, found 0"},
      {sound + "distortion_coefficients: {data: [1, 0, 0, 0, 0, 1, 0, 0]}\n"
               "distortion_model: plumb_bob\n",
       ":4: plumb_bob has 5 coefficients, and here are 8"},
      {sound + "distortion_model: rational_polynomial\n"
               "distortion_coefficients: {data: [1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0]}\n",
       ":5: rational_polynomial has 8 coefficients, and here are 12"},
      {"image_width: 16384\nimage_height: 16384\ncamera_matrix: [9e3, 0, 8e3, 0, 9e3, 8e3, 0, 0, "
       "1]\n",
       ":1: image_width and image_height are not"},
      {"image_width: 1e300\n" + sound.substr(sound.find("image_height")), "not a size"},
      {"width: 64\nheight: 48\nk: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n", ":3: camera_matrix is all 0"},
      {"a: [1, 2\n", "is not YAML"},
      {"", "is not a camera calibration"},
  };
  for (const auto& [text, message] : cases) {
    write_text(file, text);
    EXPECT_THAT([&] { read_camera_info(file); }, ThrowsMessage<InputError>(HasSubstr(message)))
        << text;
  }
  EXPECT_THROW(read_camera_info(folder / "missing.yaml"), InputError);
}

}  // namespace
}  // namespace lockbox
