// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/sensor_profile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lockbox/core/error.hpp"
#include "model/message_of.hpp"
#include "temporary_folder.hpp"

namespace lockbox {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class SensorProfileTest : public ::testing::Test {
 protected:
  SensorProfile read(const std::string& text) const {
    return read_sensor_profile(folder_.write("mine.yaml", text));
  }

  std::string refusal_of(const std::string& text) const {
    return message_of<InputError>([&] { read(text); });
  }

  TemporaryFolder folder_;
};

TEST(ShippedSensors, AreAllReadAndCanAllBeSimulated) {
  const auto names = shipped_sensor_names();
  EXPECT_THAT(names, IsSupersetOf({"primesense", "primesense-quiet", "structured-light", "stereo",
                                   "time-of-flight", "time-of-flight-biased", "white", "ideal",
                                   "kinect-v2", "azure-kinect", "d4xx", "sr300"}));
  for (const std::string& name : names) {
    const SensorProfile profile = find_sensor_profile(name);
    EXPECT_EQ(profile.name, name);
    EXPECT_FALSE(profile.description.empty()) << name;
    ASSERT_TRUE(profile.simulated) << name;
    EXPECT_EQ(profile.simulated->name, name);
    EXPECT_EQ(profile.simulated->max_range, profile.max_range) << name;
    EXPECT_THAT(sensor_names(), HasSubstr(name));
  }
}

TEST(ShippedSensors, PrimesenseErrsAsIsAssumedWhereNobodyNamesASensor) {
  EXPECT_EQ(find_sensor_profile("primesense").noise, SensorNoise{});
}

TEST(ShippedSensors, UnknownNameIsRefusedWithTheChoices) {
  EXPECT_THAT(message_of<InputError>([] { find_sensor_profile("xtion"); }),
              AllOf(HasSubstr("xtion"), HasSubstr("primesense-quiet")));
}

TEST_F(SensorProfileTest, FileIsFoundByItsName) {
  read("noise: {along_ray: {constant: 0.001, linear: 0.002, quadratic: 0.003}}");
  const SensorProfile found = find_sensor_profile((folder_ / "mine.yaml").string());
  EXPECT_EQ(found.name, "mine");
  EXPECT_EQ(found.noise.depth_floor, 0.001);
  EXPECT_EQ(found.noise.depth_linear, 0.002);
  EXPECT_EQ(found.noise.depth_quadratic, 0.003);
  EXPECT_FALSE(found.simulated);
}

TEST_F(SensorProfileTest, TakesFromAnotherWhatItDoesNotSay) {
  const SensorProfile mine = read(
      "like: time-of-flight\nrange: [0.5, 3]\nnoise: {across_ray: 2}\n"
      "simulation: {slant_bias: 0.01, grazing_angle: 60}");
  const SensorProfile other = find_sensor_profile("time-of-flight");
  EXPECT_EQ(mine.noise.lateral_pixels, 2.0);
  EXPECT_EQ(mine.noise.depth_quadratic, other.noise.depth_quadratic);
  ASSERT_TRUE(mine.simulated);
  EXPECT_EQ(mine.simulated->slant_bias, 0.01);
  EXPECT_NEAR(mine.simulated->grazing_angle, 1.0472, 1e-4);
  EXPECT_EQ(mine.simulated->depth_noise, other.simulated->depth_noise);
  EXPECT_EQ(mine.simulated->camera, other.simulated->camera);
  EXPECT_EQ(mine.simulated->min_range, 0.5);
  EXPECT_EQ(mine.simulated->name, "mine");
}

TEST_F(SensorProfileTest, RefusalNamesFileLineKeyAndWhatMayStandThere) {
  EXPECT_THAT(refusal_of("noise:\n  across_ray: 30\n"),
              AllOf(HasSubstr("mine.yaml:2"), HasSubstr("'across_ray'"), HasSubstr("0 to 20")));
  EXPECT_THAT(refusal_of("noise:\n  own_share: 1\n  sigma: 3\n"),
              AllOf(HasSubstr("mine.yaml:3"), HasSubstr("'sigma'"), HasSubstr("along_ray")));
  EXPECT_THAT(refusal_of("like: xtion\n"),
              AllOf(HasSubstr("mine.yaml:1"), HasSubstr("'like'"), HasSubstr("azure-kinect")));
  EXPECT_THAT(refusal_of("like: white\nsimulation:\n  mixes_depths: maybe\n"),
              AllOf(HasSubstr("mine.yaml:3"), HasSubstr("true or false")));
  EXPECT_THAT(refusal_of("like: white\nsimulation:\n  matching_window: 4\n"),
              AllOf(HasSubstr("mine.yaml:3"), HasSubstr("odd number")));
  EXPECT_THAT(refusal_of("like: white\nrange: [2, 1]\n"),
              AllOf(HasSubstr("mine.yaml:2"), HasSubstr("[nearest, farthest]")));
  EXPECT_THAT(refusal_of("like: white\ncamera: {width: 640}\n"),
              AllOf(HasSubstr("mine.yaml:2"), HasSubstr("'height' is missing")));
  EXPECT_THAT(refusal_of("description: nothing\n"), HasSubstr("'noise' is missing"));
}

TEST_F(SensorProfileTest, DepthCorrectionIsRead) {
  const SensorProfile mine = read(
      "like: white\n"
      "depth_correction: {scale: 0.99, offset: 0.002, quadratic: -0.01, radial: 0.05}\n");
  const DepthCorrection expected{0.99, 0.002, -0.01, 0.05};
  EXPECT_EQ(mine.depth_correction, expected);
  EXPECT_FALSE(find_sensor_profile("white").depth_correction);
  EXPECT_THAT(refusal_of("like: white\ndepth_correction:\n  scale: 1000\n"),
              AllOf(HasSubstr("mine.yaml:3"), HasSubstr("'scale'"), HasSubstr("0.5 to 2")));
  EXPECT_THAT(refusal_of("like: white\ndepth_correction:\n  quadratic: -0.15\n"),
              AllOf(HasSubstr("mine.yaml:3"), HasSubstr("nearer within the range")));
}

TEST_F(SensorProfileTest, NoiseMustNotFallToNothingWithinTheRange) {
  const std::string falling = "noise:\n  along_ray: {constant: 0.001, linear: -0.002, quadratic: ";
  EXPECT_THAT(refusal_of(falling + "0.0001}\n"),
              AllOf(HasSubstr("mine.yaml:2"), HasSubstr("'along_ray'"), HasSubstr("at z = ")));
  EXPECT_GT(read(falling + "0.002}\n").noise.sigma_z(0.5), 0.0);
}

}  // namespace
}  // namespace lockbox
