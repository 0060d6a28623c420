// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/depth_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "lockbox/capture/camera_info.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class DepthFolder : public ::testing::Test {
 protected:
  void write(std::uint64_t count) {
    DepthFolderWriter writer(path());
    for (std::uint64_t number = 0; number < count; ++number) {
      writer.write(synthetic_frame(number));
    }
  }
  std::filesystem::path path() const { return folder_ / "sequence"; }
  void expect_refusal(const std::string& message) const {
    EXPECT_THAT(
        [this] {
          DepthFolderSource source(path());
          DepthFrame frame;
          while (source.next(frame)) {
          }
        },
        ThrowsMessage<InputError>(HasSubstr(message)));
  }

  TemporaryFolder folder_;
};

TEST_F(DepthFolder, FramesComeBackExactly) {
  write(3);
  DepthFolderSource source(path());
  EXPECT_EQ(source.frame_count(), 3U);
  EXPECT_THAT(source.description(), HasSubstr("1000 units per metre"));
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 3; ++number) {
    ASSERT_TRUE(source.next(frame));
    const DepthFrame expected = synthetic_frame(number);
    EXPECT_EQ(frame.depth, expected.depth);
    EXPECT_EQ(frame.camera, expected.camera);
    EXPECT_EQ(frame.stamp, expected.stamp);
    EXPECT_EQ(frame.metres_per_unit, expected.metres_per_unit);
    EXPECT_EQ(frame.index, number);
  }
  EXPECT_FALSE(source.next(frame));
}

TEST_F(DepthFolder, TheScaleComesFromOptionsThenFileThenMillimetres) {
  write(1);
  DepthFrame frame;
  SourceOptions options;
  options.depth_scale = 5000.0;
  ASSERT_TRUE(DepthFolderSource(path(), options).next(frame));
  EXPECT_FLOAT_EQ(frame.metres_per_unit, 0.0002F);
  write_camera_info(path() / "camera_info.yaml",
                    {.camera = small_camera(), .distortion = {}, .depth_scale = 4000.0});
  ASSERT_TRUE(DepthFolderSource(path()).next(frame));
  EXPECT_FLOAT_EQ(frame.metres_per_unit, 0.00025F);
  write_camera_info(path() / "camera_info.yaml",
                    {.camera = small_camera(), .distortion = {}, .depth_scale = {}});
  ASSERT_TRUE(DepthFolderSource(path()).next(frame));
  EXPECT_FLOAT_EQ(frame.metres_per_unit, 0.001F);
}

TEST_F(DepthFolder, ImplausibleDepthsAreToldOnce) {
  write(3);
  SourceOptions options;
  std::vector<std::string> warnings;
  options.depth_scale = 1.0;
  options.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  DepthFolderSource source(path(), options);
  DepthFrame frame;
  while (source.next(frame)) {
  }
  EXPECT_THAT(warnings, ::testing::ElementsAre(HasSubstr("depth scale")));
}

TEST_F(DepthFolder, ProblemsInTheIndexNameTheLine) {
  write(2);
  write_text(path() / "depth.txt", "# comment\n\n0.0 depth/000000.png\n0,1 depth/000001.png\n");
  expect_refusal("depth.txt:4: expected");
  write_text(path() / "depth.txt", "0.0 depth/000000.png\n0.1 depth/missing.png\n");
  expect_refusal("depth.txt:2: there is no image");
  write_text(path() / "depth.txt", "0.1 depth/000000.png\n0.1 depth/000001.png\n");
  expect_refusal("depth.txt:2: timestamps do not increase");
  write_text(path() / "depth.txt", "# nothing\n");
  expect_refusal("lists no images");
}

TEST_F(DepthFolder, AMissingCameraIsRefusedWithAdvice) {
  write(1);
  std::filesystem::remove(path() / "camera_info.yaml");
  expect_refusal("--camera-info");
}

TEST_F(DepthFolder, DamagedAndForeignImagesAreNamed) {
  write(1);
  const std::filesystem::path image = path() / "depth" / "000000.png";
  const std::uintmax_t size = std::filesystem::file_size(image);
  std::filesystem::resize_file(image, size / 2);
  expect_refusal("000000.png: is damaged or truncated");
  write_text(image, "no image");
  expect_refusal("000000.png: is not a sound PNG image");
}

TEST_F(DepthFolder, ACameraOfAnotherSizeIsRefused) {
  write(1);
  SourceOptions options;
  options.camera = PinholeCamera{640, 480, 500, 500, 319.5, 239.5};
  DepthFolderSource source(path(), options);
  DepthFrame frame;
  EXPECT_THAT([&] { source.next(frame); },
              ThrowsMessage<InputError>(HasSubstr("160x120 but the camera calibration is for")));
}

TEST_F(DepthFolder, ASequenceIsNotOverwritten) {
  write(1);
  EXPECT_THROW(DepthFolderWriter{path()}, InputError);
}

TEST_F(DepthFolder, DistortionIsUndone) {
  // A barrel-distorted image whose depth tells the normalized radius of each pixel's ray.
  const CameraCalibration calibration{
      .camera = small_camera(), .distortion = {-0.2, 0.05, 0.001, -0.002, 0.0}, .depth_scale = {}};
  const PinholeCamera& camera = calibration.camera;
  DepthFrame bent = synthetic_frame(0);
  const auto depth_of = [](double x, double y) {
    return static_cast<std::uint16_t>(1000.0 + 4000.0 * std::hypot(x, y));
  };
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      // Undistorts the ray by fixed-point iteration, the inverse of what the source does.
      const double xd = (u - camera.cx) / camera.fx;
      const double yd = (v - camera.cy) / camera.fy;
      double x = xd;
      double y = yd;
      for (int i = 0; i < 50; ++i) {
        const double r2 = x * x + y * y;
        const double radial = 1.0 - 0.2 * r2 + 0.05 * r2 * r2;
        const double dx = 2 * 0.001 * x * y - 0.002 * (r2 + 2 * x * x);
        const double dy = 0.001 * (r2 + 2 * y * y) - 2 * 0.002 * x * y;
        x = (xd - dx) / radial;
        y = (yd - dy) / radial;
      }
      bent.depth[static_cast<std::size_t>(v * camera.width + u)] = depth_of(x, y);
    }
  }
  {
    DepthFolderWriter writer(path());
    writer.write(bent);
  }
  write_camera_info(path() / "camera_info.yaml", calibration);
  DepthFrame frame;
  ASSERT_TRUE(DepthFolderSource(path()).next(frame));
  EXPECT_EQ(frame.camera, camera);
  int measured = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const std::uint16_t depth = frame.depth[static_cast<std::size_t>(v * camera.width + u)];
      const int expected = depth_of((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      if (depth != 0) {
        EXPECT_NEAR(depth, expected, 25) << u << " " << v;  // nearest pixel: 4000 / fx * 0.75
        ++measured;
      }
    }
  }
  EXPECT_EQ(measured, camera.width * camera.height);  // barrel distortion fills all
}

TEST(CameraInfo, NumbersComeBackExactly) {
  const TemporaryFolder folder;
  const CameraCalibration written{.camera = {640, 480, 607.178466796875, 1.0 / 3.0, 319.1, 0.1},
                                  .distortion = {0.1, -0.2, 1e-9, 0.0, 5.5},
                                  .depth_scale = 5000.0};
  write_camera_info(folder / "camera_info.yaml", written);
  const CameraCalibration read = read_camera_info(folder / "camera_info.yaml");
  EXPECT_EQ(read.camera, written.camera);
  EXPECT_EQ(read.distortion, written.distortion);
  EXPECT_EQ(read.depth_scale, written.depth_scale);
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
      {sound + "distortion_model: equidistant\ndistortion_coefficients: {data: [1, 0, 0, 0]}\n",
       ":4: distortion model equidistant is not supported"},
      {sound + "distortion_coefficients: {data: [1, 0]}\n", ":4: plumb_bob needs 5"},
      {"a: [1, 2\n", "is not valid YAML"},
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
