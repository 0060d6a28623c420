// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lockbox/simulation/deviation.hpp"
#include "written_file.hpp"

namespace lockbox {
namespace {

using ::testing::HasSubstr;

class DeviationFile : public WrittenFile {
 protected:
  Deviation read(const std::string& text) const { return read_deviation(write(text)); }
  std::string complaint(const std::string& text) const {
    return complaint_of(read_deviation, text);
  }
};

TEST_F(DeviationFile, EverythingThatItSaysIsReadAndWrittenAgain) {
  const Deviation deviation = read(R"(
seed: 7
object:
  scale: 1.01
  sizes: 0.002
  bend: 0.005
  joint_origins: 0.003
  joint_axes: 0.0087
  added_parts: 3
  added_share: 0.15
  missing_handles: 1
  missing_parts: [door, drawer]
camera: {focal_length: 1.015, principal_point: [6, -3], distortion: [0.06, -0.15]}
depth: {scale: 0.99, bend: 0.006, corners: 0.02}
frames: {rate: 15, repeated: 0.1, missing: 0.2}
)");
  EXPECT_EQ(deviation.seed, 7U);
  EXPECT_EQ(deviation.object.scale, 1.01);
  EXPECT_EQ(deviation.object.sizes, 0.002);
  EXPECT_EQ(deviation.object.bend, 0.005);
  EXPECT_EQ(deviation.object.joint_origins, 0.003);
  EXPECT_EQ(deviation.object.joint_axes, 0.0087);
  EXPECT_EQ(deviation.object.added_parts, 3);
  EXPECT_EQ(deviation.object.added_share, 0.15);
  EXPECT_EQ(deviation.object.missing_handles, 1);
  EXPECT_THAT(deviation.object.missing_parts, ::testing::ElementsAre("door", "drawer"));
  EXPECT_EQ(deviation.sensor.camera.focal_length, 1.015);
  EXPECT_EQ(deviation.sensor.camera.principal_point, Eigen::Vector2d(6.0, -3.0));
  EXPECT_EQ(deviation.sensor.camera.distortion, Eigen::Vector2d(0.06, -0.15));
  EXPECT_EQ(deviation.sensor.depth.scale, 0.99);
  EXPECT_EQ(deviation.sensor.depth.bend, 0.006);
  EXPECT_EQ(deviation.sensor.depth.corners, 0.02);
  EXPECT_EQ(deviation.frames.rate, 15.0);
  EXPECT_EQ(deviation.frames.repeated, 0.1);
  EXPECT_EQ(deviation.frames.missing, 0.2);
  const std::string text = deviation_text(deviation);
  EXPECT_EQ(deviation_text(read(text)), text);
}

TEST_F(DeviationFile, WhatItDoesNotSayDoesNotDeviate) {
  EXPECT_EQ(deviation_text(read("object: {}")), deviation_text(Deviation{}));
}

TEST_F(DeviationFile, WhatIsWrongIsRefusedWithFileAndKey) {
  EXPECT_THAT(complaint("objet: {}"), HasSubstr("'objet'"));
  EXPECT_THAT(complaint("objet: {}"), HasSubstr((folder_ / "written.yaml").string()));
  EXPECT_THAT(complaint("seed: 1\nobject:\n  size: 0.1"), HasSubstr(":3"));
  EXPECT_THAT(complaint("object: {size: 0.1}"), HasSubstr("'size'"));
  EXPECT_THAT(complaint("object: {sizes: -0.1}"), HasSubstr("'sizes'"));
  EXPECT_THAT(complaint("object: {scale: 0}"), HasSubstr("'scale'"));
  EXPECT_THAT(complaint("object: {added_parts: 1.5}"), HasSubstr("'added_parts'"));
  EXPECT_THAT(complaint("object: {missing_parts: door}"), HasSubstr("'missing_parts'"));
  EXPECT_THAT(complaint("camera: {principal_point: 6}"), HasSubstr("'principal_point'"));
  EXPECT_THAT(complaint("camera: {distortion: [9, 0]}"), HasSubstr("'distortion'"));
  EXPECT_THAT(complaint("depth: {bent: 1}"), HasSubstr("'bent'"));
  EXPECT_THAT(complaint("frames: {repeated: 2}"), HasSubstr("'repeated'"));
  EXPECT_THAT(complaint("seed: -1"), HasSubstr("'seed'"));
  EXPECT_THAT(complaint("object: {scale: [1"), HasSubstr("is not YAML"));
}

}  // namespace
}  // namespace lockbox
