// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/noise_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lockbox {
namespace {

/// A wall square on, of which each pixel errs by itself.
DepthFrame wall(double z, double sigma, unsigned seed = 1) {
  DepthFrame frame;
  frame.camera = {320, 240, 288.0, 288.0, 159.5, 119.5};
  frame.metres_per_unit = 0.0001F;
  std::mt19937 generator(seed);
  std::normal_distribution<double> error(0.0, sigma);
  frame.depth.resize(std::size_t{320} * 240);
  for (auto& depth : frame.depth) {
    depth = static_cast<std::uint16_t>(std::lround(1e4 * (z + error(generator))));
  }
  return frame;
}

double sigma_at(const NoiseRecord& record, double z) {
  const auto noise = record.noise();
  return noise ? noise->sigma_z(z) : -1.0;
}

TEST(NoiseRecord, TellsTheNoiseOfAWallAndThatPixelsErrByThemselves) {
  NoiseRecord record;
  record.look_at(wall(1.2, 0.003));
  EXPECT_NEAR(sigma_at(record, 1.2), 0.003, 0.0003);
  EXPECT_LT(record.noise()->correlation_area(), 2.0);
}

TEST(NoiseRecord, TellsNothingBeforeAnImageDoes) {
  NoiseRecord record;
  EXPECT_FALSE(record.noise());
  DepthFrame nothing = wall(1.0, 0.001);
  nothing.depth.assign(nothing.depth.size(), 0);
  record.look_at(nothing);
  EXPECT_FALSE(record.noise());
  record.look_at(wall(1.0, 0.001));
  EXPECT_TRUE(record.noise());
}

TEST(NoiseRecord, DoesNotTakeAMessForNoise) {
  NoiseRecord record;
  record.look_at(wall(1.0, 0.1));
  EXPECT_FALSE(record.noise());
}

TEST(NoiseRecord, BelievesFarNoiseThatGrowsAsSquaresDo) {
  NoiseRecord record;
  record.look_at(wall(3.5, 0.0055 * 3.5 * 3.5));
  EXPECT_NEAR(sigma_at(record, 3.5), 0.067, 0.007);
}

TEST(NoiseRecord, LearnsWhatDepthsTellThatComeLater) {
  // As a time-of-flight camera: half as much at a third of the distance, not a ninth.
  NoiseRecord record;
  record.look_at(wall(3.0, 0.003));
  EXPECT_LT(sigma_at(record, 1.0), 0.001) << "no image has told it";
  record.look_at(wall(1.0, 0.0015));
  EXPECT_NEAR(sigma_at(record, 1.0), 0.0015, 0.0002);
  EXPECT_NEAR(sigma_at(record, 3.0), 0.003, 0.0004);
}

TEST(NoiseRecord, CountsLaterImagesMore) {
  NoiseRecord record;
  record.look_at(wall(1.0, 0.001));
  for (unsigned seed = 2; seed < 7; ++seed) record.look_at(wall(1.0, 0.002, seed));
  EXPECT_NEAR(sigma_at(record, 1.0), 0.002, 0.0002);
}

TEST(NoiseRecord, KnowsThatRoundingErrs) {
  DepthFrame rounded = wall(1.0, 0.0);
  rounded.metres_per_unit = 0.001F;
  for (auto& depth : rounded.depth) depth = 1000;
  NoiseRecord record;
  record.look_at(rounded);
  EXPECT_NEAR(sigma_at(record, 1.0), 0.001 / std::sqrt(12.0), 2e-5);
  // Where a face begins to be rounded to the next unit, all its pixels are.
  EXPECT_EQ(record.noise()->correlation_area(), SensorNoise{}.correlation_area());
}

TEST(NoiseRecord, KnowsThatFewDepthsErr) {
  // Disparities in eighths of a pixel, at 75 mm and 575.8 pixels: 2.9 mm apart at a metre.
  const double step = 0.125 / (575.8 * 0.075);
  const auto rounded = [&](double z) { return 1.0 / (step * std::round(1.0 / (z * step))); };
  DepthFrame frame = wall(1.0, 0.0);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {  // a ramp, so flat that most neighbours have one depth
      const double z = rounded(2.0 + 0.0005 * u);
      frame.depth[static_cast<std::size_t>(v) * 320 + static_cast<std::size_t>(u)] =
          static_cast<std::uint16_t>(std::lround(1e4 * z));
    }
  }
  NoiseRecord record;
  record.look_at(frame);
  const double rounding = 4.0 * step / std::sqrt(12.0);  // its differences alone say 0.3 mm
  EXPECT_GT(sigma_at(record, 2.0), 0.8 * rounding);
  EXPECT_LT(sigma_at(record, 2.0), 1.3 * rounding);
}

}  // namespace
}  // namespace lockbox
