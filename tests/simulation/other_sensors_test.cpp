// SPDX-License-Identifier: BSD-3-Clause
// Stereo and time-of-flight cameras.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "measured_frame.hpp"

namespace lockbox {
namespace {

/// What stereo matching does, without noise, rounding and drop-outs.
SensorModel matching_only() {
  SensorModel sensor = sensor_model("stereo");
  sensor.disparity_noise = 0.0;
  sensor.disparity_step = 0.0;
  sensor.dropout_rate = 0.0;
  sensor.hole_share = 0.0;
  return sensor;
}

TEST(Stereo, GrowsWhatIsInFrontByTwoToFourPixelsOnBothSides) {
  const auto board = [](double u, double) { return u > 299.5 && u < 400.5 ? 1.0 : 2.0; };
  const DepthFrame frame = measured(matching_only(), board);
  std::set<int> growths;
  double sum = 0.0;
  for (int v = 0; v < kSimulatedCamera.height; ++v) {
    int left = 300;
    int right = 400;
    while (frame.metres(left - 1, v) == 1.0F) --left;
    while (frame.metres(right + 1, v) == 1.0F) ++right;
    for (const int growth : {300 - left, right - 400}) {
      growths.insert(growth);
      sum += growth;
    }
  }
  EXPECT_EQ(growths, (std::set<int>{2, 3, 4}));
  EXPECT_NEAR(sum / (2.0 * kSimulatedCamera.height), 3.0, 0.3);
}

TEST(Stereo, MeasuresNothingWhereOneCameraLooksAlone) {
  // Disparities of 28.8 and 14.4 pixels, of whose difference the board's growth takes up to four.
  const auto board = [](double u, double) { return u > 299.5 && u < 400.5 ? 1.0 : 2.0; };
  const auto hidden = unmeasured_columns(measured(matching_only(), board));
  EXPECT_NEAR(*hidden.begin(), 299.5 - 14.4, 1.0);
  EXPECT_GE(hidden.size(), 10U);
  EXPECT_LE(*hidden.rbegin(), 297);
}

TEST(Stereo, AveragesStepsOverFivePixels) {
  // 20 mm at 1.2 m are 0.4 pixels of disparity: the same surface.
  const auto step = [](double u, double) { return u < 319.5 ? 1.2 : 1.22; };
  const DepthFrame frame = measured(matching_only(), step);
  EXPECT_EQ(frame.metres(317, 240), 1.2F);
  EXPECT_NEAR(frame.metres(318, 240), 1.204, 0.0006);
  EXPECT_NEAR(frame.metres(319, 240), 1.208, 0.0006);
  EXPECT_NEAR(frame.metres(320, 240), 1.212, 0.0006);
  EXPECT_NEAR(frame.metres(322, 240), 1.22, 1e-6);
}

/// Errors of the columns in [begin, end): mean, and standard deviation.
std::pair<double, double> errors_of(const DepthFrame& frame, int begin, int end,
                                    const std::function<double(double, double)>& z) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int v = 0; v < kSimulatedCamera.height; ++v) {
    for (int u = begin; u < end; ++u) {
      if (frame.metres(u, v) == 0.0F) continue;
      const double error = frame.metres(u, v) - z(u, v);
      sum += error;
      squares += error * error;
      count += 1.0;
    }
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean)};
}

TEST(Stereo, HasTheNoiseOfEightHundredthsOfAPixel) {
  const auto wall = [](double, double) { return 1.9; };
  const auto [mean, sigma] = errors_of(measured(sensor_model("stereo"), wall), 0, 640, wall);
  // 1.9^2 / (575.8 * 0.05) metres a pixel, and 1/32 of a pixel rounded.
  const double expected = 3.61 / 28.79 * std::hypot(0.08, 1.0 / 32.0 / std::sqrt(12.0));
  EXPECT_NEAR(sigma / expected, 1.0, 0.05);
  EXPECT_NEAR(mean, 0.0, 0.001);
}

TEST(Stereo, HasHolesInBlobs) {
  SensorModel sensor = matching_only();
  sensor.hole_share = sensor_model("stereo").hole_share;
  int holes = 0;
  int beside = 0;
  for (std::uint64_t index = 0; index < 3; ++index) {
    const DepthFrame frame = measured(sensor, flat_wall, index);
    for (int i = 1; i < 640 * 480; ++i) {
      if (frame.depth[static_cast<std::size_t>(i)] != 0) continue;
      ++holes;
      beside += frame.depth[static_cast<std::size_t>(i - 1)] == 0 ? 1 : 0;
    }
  }
  EXPECT_NEAR(holes / (3.0 * 640.0 * 480.0), 0.01, 0.004);
  EXPECT_GT(beside, 0.7 * holes);
}

TEST(TimeOfFlight, HasWhiteNoiseThatGrowsWithDepthAndIncidence) {
  for (const double z : {1.0, 2.0}) {
    const auto wall = [z](double, double) { return z; };
    const DepthFrame frame = measured(sensor_model("time-of-flight"), wall);
    // In the middle of the image, where rays are normal to the wall.
    const auto [mean, sigma] = errors_of(frame, 300, 340, wall);
    EXPECT_NEAR(sigma, std::hypot(0.0008 + 0.0007 * z * z, 0.001 / std::sqrt(12.0)), 2e-4) << z;
    EXPECT_NEAR(mean, 0.0, 4e-4) << z;
  }
  const auto slanted = [](double u, double) { return slanted_wall(60.0, u); };
  SensorModel sensor = sensor_model("time-of-flight");
  const auto [mean, sigma] = errors_of(measured(sensor, slanted), 310, 330, slanted);
  EXPECT_NEAR(sigma, (0.0008 + 0.0007 * 1.44) / 0.5, 3e-4);
}

TEST(TimeOfFlight, MeasuresSlantedFacesTooLong) {
  const auto slanted = [](double u, double) { return slanted_wall(60.0, u); };
  for (const auto& [name, bias] :
       {std::pair("time-of-flight", 0.006), std::pair("time-of-flight-biased", 0.020)}) {
    const auto [mean, sigma] = errors_of(measured(sensor_model(name), slanted), 310, 330, slanted);
    EXPECT_NEAR(mean, bias * (1.0 - 0.5), 5e-4) << name;
  }
}

TEST(TimeOfFlight, MixesDepthsInAPixelAtAnEdge) {
  SensorModel sensor = sensor_model("time-of-flight");
  sensor.depth_noise = sensor.depth_noise_growth = sensor.slant_bias = sensor.dropout_rate = 0.0;
  const auto step = [](double u, double) { return u < 319.75 ? 1.2 : 1.7; };
  const DepthFrame frame = measured(sensor, step);
  EXPECT_EQ(frame.metres(319, 240), 1.2F);
  // A quarter of its footprint is near, and as bright as twice the area of the far.
  EXPECT_NEAR(frame.metres(320, 240), 1.4996, 0.001);
  EXPECT_EQ(frame.metres(321, 240), 1.7F);
}

TEST(TimeOfFlight, LosesGrazingFaces) {
  EXPECT_LT(share_without_depth_at_incidence(70.0, "time-of-flight"), 0.02);
  // 1 - cos(82) / cos(75) = 0.462
  EXPECT_NEAR(share_without_depth_at_incidence(82.0, "time-of-flight"), 0.46, 0.1);
}

TEST(FarReachingSensor, EndsWhereTheMillimetresOfAnImageDo) {
  SensorModel sensor = sensor_model("ideal");
  sensor.max_range = 100.0;
  const auto at = [&sensor](double z) {
    return measured(sensor, [z](double, double) { return z; }).metres(300, 200);
  };
  EXPECT_NEAR(at(65.53), 65.53, 1e-3);
  EXPECT_EQ(at(70.0), 0.0F);
}

}  // namespace
}  // namespace lockbox
