// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/depth_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "depth_folder_fixture.hpp"
#include "lockbox/capture/camera_info.hpp"
#include "lockbox/core/error.hpp"
#include "synthetic_frames.hpp"
#include "text_file.hpp"

namespace lockbox {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

TEST_F(DepthFolder, FramesComeBackExactly) {
  write(3);
  DepthFolderSource source(path());
  EXPECT_EQ(source.frame_count(), 3U);
  EXPECT_THAT(source.description(), HasSubstr("1000 units per metre"));
  SourceOptions in_metres;
  in_metres.depth_scale = 1.0;
  EXPECT_THAT(DepthFolderSource(path(), in_metres).description(), HasSubstr(", 1 unit per metre"));
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

TEST_F(DepthFolder, ImplausibleDepthsAreToldOnceWithTheScaleThatFits) {
  write(3);
  SourceOptions options;
  options.depth_scale = 1.0;
  EXPECT_THAT(warnings_of(path(), options),
              ElementsAre(AllOf(HasSubstr("depth scale"), HasSubstr("--depth-scale 1000)"))));
  options.depth_scale = 100000.0;
  EXPECT_THAT(warnings_of(path(), options), ElementsAre(HasSubstr("nearer than")));
  options.depth_scale = 1000.0;
  EXPECT_THAT(warnings_of(path(), options), IsEmpty());
}

TEST_F(DepthFolder, ImagesInFinerUnitsThanMillimetresAreRecognised) {
  for (const int factor : {5, 10}) {
    const std::filesystem::path folder = folder_ / std::to_string(factor);
    DepthFrame frame = synthetic_frame(0);
    for (std::uint16_t& depth : frame.depth) {
      depth = static_cast<std::uint16_t>(depth * factor);
    }
    DepthFolderWriter(folder).write(frame);
    write_camera_info(folder / "camera_info.yaml",
                      {.camera = small_camera(), .distortion = {}, .depth_scale = {}});
    const std::string advice = "--depth-scale " + std::to_string(1000 * factor);
    EXPECT_THAT(warnings_of(folder), ElementsAre(HasSubstr(advice)));
    SourceOptions options;
    options.depth_scale = 1000.0 * factor;
    EXPECT_THAT(warnings_of(folder, options), IsEmpty());
  }
}

TEST_F(DepthFolder, StampsInOtherUnitsAreBroughtToSeconds) {
  write(3);
  const auto stamps_of = [this](const std::string& index) {
    write_text(path() / "depth.txt", index);
    DepthFolderSource source(path());
    std::vector<double> stamps;
    for (DepthFrame frame; source.next(frame);) {
      stamps.push_back(frame.stamp);
    }
    return stamps;
  };
  using ::testing::DoubleNear;
  EXPECT_THAT(stamps_of("1700000000000000000 depth/000000.png\n"
                        "1700000000033333333 depth/000001.png\n"),
              ElementsAre(1.7e9, DoubleNear(1.7e9 + 0.033333333, 1e-6)));
  EXPECT_THAT(warnings_of(path()), ElementsAre(HasSubstr("nanoseconds")));
  EXPECT_THAT(stamps_of("0 depth/000000.png\n33333 depth/000001.png\n66667 depth/000002.png\n"),
              ElementsAre(0.0, 0.033333, 0.066667));
  EXPECT_THAT(stamps_of("0 depth/000000.png\n33 depth/000001.png\n67 depth/000002.png\n"),
              ElementsAre(0.0, 33.0, 67.0));
  EXPECT_THAT(warnings_of(path()), ElementsAre(HasSubstr("divide them by 1000")));
}

TEST_F(DepthFolder, LinesInDisorderAreSortedByStampsAndSaid) {
  write(3);
  write_text(path() / "depth.txt",
             "0.2 depth/000002.png\n0 depth/000000.png\n0.1 depth/000001.png\n0.");
  DepthFolderSource source(path());
  DepthFrame frame;
  for (std::uint64_t number = 0; number < 3; ++number) {
    ASSERT_TRUE(source.next(frame));
    EXPECT_EQ(frame.depth, synthetic_frame(number).depth);
  }
  EXPECT_FALSE(source.next(frame));  // the line that was cut off counts for nothing
  EXPECT_THAT(warnings_of(path()), ElementsAre(HasSubstr("not in the order of their timestamps")));
}

TEST_F(DepthFolder, ProblemsInTheIndexNameTheLine) {
  write(2);
  write_text(path() / "depth.txt", "# comment\n\n0.0 depth/000000.png\n0,1 depth/000001.png\n");
  expect_refusal("depth.txt:4: expected");
  write_text(path() / "depth.txt", "0.0 depth/000000.png\n0.1\n0.2 depth/000001.png\n");
  expect_refusal("depth.txt:2: expected");
  write_text(path() / "depth.txt", "# comment\n0.0 depth/no_such.png\n0.1 depth/neither.png\n");
  expect_refusal("no_such.png: no such image, or it cannot be read (line 2 of depth.txt)");
  write_text(path() / "depth.txt", "# nothing\n");
  expect_refusal("lists no images");
}

TEST_F(DepthFolder, AMissingCameraIsRefusedWithAdvice) {
  write(1);
  std::filesystem::remove(path() / "camera_info.yaml");
  expect_refusal("--camera-info");
}

TEST_F(DepthFolder, ACameraOfAnotherSizeIsRefused) {
  write(1);
  SourceOptions options;
  options.camera = PinholeCamera{640, 480, 500, 500, 319.5, 239.5};
  EXPECT_THAT([&] { DepthFolderSource(path(), options); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("160x120 but the camera calibration is for 640x480"),
                        HasSubstr("multiply its size, fx, fy, cx and cy by 0.25"))));
  options.camera = PinholeCamera{120, 160, 144, 144, 59.5, 79.5};
  EXPECT_THAT([&] { DepthFolderSource(path(), options); },
              ThrowsMessage<InputError>(HasSubstr("width and height are exchanged")));
}

TEST_F(DepthFolder, ASequenceIsNotOverwritten) {
  write(1);
  EXPECT_THROW(DepthFolderWriter{path()}, InputError);
}

TEST_F(DepthFolder, EquidistantDistortionIsUndone) {
  // The depth of each bent pixel tells the tangent of its ray's angle.
  const CameraCalibration calibration{.camera = small_camera(),
                                      .distortion = {0.1, -0.02, 0.0, 0.0},
                                      .depth_scale = {},
                                      .is_equidistant = true};
  const PinholeCamera& camera = calibration.camera;
  DepthFrame bent = synthetic_frame(0);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double seen = std::hypot((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
      double angle = seen;
      for (int i = 0; i < 50; ++i) {
        angle = seen / (1.0 + 0.1 * angle * angle - 0.02 * std::pow(angle, 4));
      }
      bent.depth[static_cast<std::size_t>(v * camera.width + u)] =
          static_cast<std::uint16_t>(1000.0 + 4000.0 * std::tan(angle));
    }
  }
  {
    DepthFolderWriter writer(path());
    writer.write(bent);
  }
  write_camera_info(path() / "camera_info.yaml", calibration);
  DepthFrame frame;
  ASSERT_TRUE(DepthFolderSource(path()).next(frame));
  int measured = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.back_project(u, v, 1.0);
      const double depth = frame.depth[static_cast<std::size_t>(v * camera.width + u)];
      if (depth == 0.0) continue;
      ++measured;
      // The nearest pixel is up to 0.71 pixels off, which a lens that bends makes no more than 1.5.
      EXPECT_NEAR(depth, 1000.0 + 4000.0 * ray.head<2>().norm(), 1.5 * 4000.0 / camera.fx);
    }
  }
  EXPECT_GT(measured, camera.width * camera.height / 2);
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

}  // namespace
}  // namespace lockbox
