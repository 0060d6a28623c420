// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/sensor_simulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "measured_frame.hpp"

namespace lockbox {
namespace {

/// The disparity noise before rounding, seen through a sensor that does not round.
SensorModel disparity_noise_only() {
  SensorModel sensor = sensor_model("primesense");
  sensor.disparity_step = 0.0;
  sensor.disparity_noise = 5.0;  // so large that the output's millimetres do not matter
  sensor.dropout_rate = 0.0;
  sensor.max_range = 65.0;
  sensor.min_range = 0.0;
  return sensor;
}

double disparity(double z) {
  return kSimulatedCamera.fx * 0.075 / z;
}

TEST(IdealSensor, DeliversWholeMillimetresOfTheCleanDepth) {
  const auto slope = [](double u, double v) { return 0.3 + 0.004 * u + 0.001 * v; };
  const DepthFrame frame = measured(sensor_model("ideal"), slope, 7);
  EXPECT_EQ(frame.camera, kSimulatedCamera);
  EXPECT_EQ(frame.index, 7U);
  for (int v = 0; v < kSimulatedCamera.height; v += 3) {
    for (int u = 0; u < kSimulatedCamera.width; ++u) {
      ASSERT_NEAR(frame.metres(u, v), slope(u, v), 0.5001e-3) << u << " " << v;
    }
  }
}

TEST(IdealSensor, SeesNothingWhereNothingIs) {
  const DepthFrame frame =
      measured(sensor_model("ideal"), [](double u, double) { return u < 300 ? 1.0 : kInfinity; });
  EXPECT_EQ(frame.metres(299, 100), 1.0F);
  EXPECT_EQ(frame.metres(300, 100), 0.0F);
}

TEST(PrimesenseNoise, HasTheStatedDeviationAndNoBias) {
  const DepthFrame frame = measured(disparity_noise_only(), flat_wall);
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (int v = 0; v < kSimulatedCamera.height; ++v) {
    for (int u = 0; u < kSimulatedCamera.width; ++u) {
      const double error = disparity(frame.metres(u, v)) - disparity(1.2);
      sum += error;
      sum_of_squares += error * error;
    }
  }
  const double pixels = kSimulatedCamera.width * kSimulatedCamera.height;
  // 307200 pixels are worth 5400 independent ones: the mean is known to 0.07, the deviation to 1 %.
  EXPECT_NEAR(sum / pixels, 0.0, 0.25);
  EXPECT_NEAR(std::sqrt(sum_of_squares / pixels), 5.0, 0.2);
}

TEST(PrimesenseNoise, CorrelatesOverThreePixelsInBothDirections) {
  const DepthFrame frame = measured(disparity_noise_only(), flat_wall);
  const auto error = [&](int u, int v) { return disparity(frame.metres(u, v)) - disparity(1.2); };
  for (const int lag : {1, 3, 6, 12}) {
    double along_rows = 0.0;
    double along_columns = 0.0;
    double variance = 0.0;
    for (int v = 0; v < kSimulatedCamera.height - lag; ++v) {
      for (int u = 0; u < kSimulatedCamera.width - lag; ++u) {
        variance += error(u, v) * error(u, v);
        along_rows += error(u, v) * error(u + lag, v);
        along_columns += error(u, v) * error(u, v + lag);
      }
    }
    const double expected = std::exp(-lag * lag / 18.0);
    EXPECT_NEAR(along_rows / variance, expected, 0.05) << lag;
    EXPECT_NEAR(along_columns / variance, expected, 0.05) << lag;
  }
}

TEST(PrimesenseNoise, MeanOverAPatchFollowsTheCorrelationArea) {
  // Patches of 40 x 40 pixels, wide against the correlation length. Their mean has the variance
  // sigma^2 area / 1600, a little less for what is cut off at the patch's border (6 % a side pair).
  const SensorModel sensor = disparity_noise_only();
  double sum_of_squares = 0.0;
  int patches = 0;
  for (std::uint64_t index = 0; index < 4; ++index) {
    const DepthFrame frame = measured(sensor, flat_wall, index);
    for (int v0 = 0; v0 < 480; v0 += 40) {
      for (int u0 = 0; u0 < 640; u0 += 40) {
        double sum = 0.0;
        for (int v = v0; v < v0 + 40; ++v) {
          for (int u = u0; u < u0 + 40; ++u) {
            sum += disparity(frame.metres(u, v)) - disparity(1.2);
          }
        }
        sum_of_squares += sum / 1600.0 * sum / 1600.0;
        ++patches;
      }
    }
  }
  const double expected = 25.0 * correlation_area(sensor) / 1600.0;
  EXPECT_NEAR(sum_of_squares / patches / expected, 0.88, 0.12);
}

TEST(PrimesenseNoise, DisparitiesAreMultiplesOfAnEighth) {
  SensorModel sensor = sensor_model("primesense");
  const DepthFrame frame = measured(sensor, flat_wall);
  std::set<int> steps;
  for (int i = 0; i < 640 * 480; ++i) {
    const double z = frame.metres(i % 640, i / 640);
    if (z > 0.0) {
      // A millimetre at 1.2 m is 0.03 px; an eighth is 4.2 mm.
      const double eighths = 8.0 * disparity(z);
      ASSERT_NEAR(eighths, std::round(eighths), 0.13);
      steps.insert(static_cast<int>(std::round(eighths)));
    }
  }
  // 36.0 px with a deviation of 0.08 px: a handful of steps.
  EXPECT_GE(steps.size(), 4U);
  EXPECT_LE(steps.size(), 9U);
}

TEST(PrimesenseNoise, RoundedDepthHasThePredictedDeviation) {
  for (const double z : {0.8, 1.2, 2.5}) {
    const DepthFrame frame =
        measured(sensor_model("primesense"), [z](double, double) { return z; });
    double sum_of_squares = 0.0;
    int count = 0;
    for (int i = 0; i < 640 * 480; ++i) {
      const double seen = frame.metres(i % 640, i / 640);
      if (seen > 0.0) {
        sum_of_squares += (seen - z) * (seen - z);
        ++count;
      }
    }
    const double expected = depth_sigma(sensor_model("primesense"), kSimulatedCamera, z);
    EXPECT_NEAR(std::sqrt(sum_of_squares / count) / expected, 1.0, 0.06) << z;
  }
}

TEST(WhiteNoise, HasTheStatedDeviationAndNeighboursAreIndependent) {
  const DepthFrame frame = measured(sensor_model("white"), [](double, double) { return 2.0; });
  double variance = 0.0;
  double neighbours = 0.0;
  double tails = 0.0;
  const double sigma = depth_sigma(sensor_model("white"), kSimulatedCamera, 2.0);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 639; ++u) {
      const double error = frame.metres(u, v) - 2.0;
      variance += error * error;
      neighbours += error * (frame.metres(u + 1, v) - 2.0);
      tails += std::abs(error) > 0.0185 ? 1.0 : 0.0;
    }
  }
  const double pixels = 480.0 * 639.0;
  EXPECT_NEAR(std::sqrt(variance / pixels) / sigma, 1.0, 0.01);
  EXPECT_NEAR(neighbours / variance, 0.0, 0.01);
  // 19 mm and more, that is 18.5 / 6.064 = 3.051 deviations before rounding.
  EXPECT_NEAR(tails / pixels, 0.00228, 0.0004);
}

TEST(LateralJitter, HasHalfAPixelOfDeviationAlongBothAxes) {
  // On a ramp of 10 mm a pixel the jitter shows as depth noise of 5 mm.
  SensorModel sensor = sensor_model("ideal");
  sensor.lateral_jitter = 0.5;
  for (const auto& ramp :
       {std::function<double(double, double)>([](double u, double) { return 1.0 + 0.01 * u; }),
        std::function<double(double, double)>([](double, double v) { return 1.0 + 0.01 * v; })}) {
    const DepthFrame frame = measured(sensor, ramp);
    double sum = 0.0;
    double sum_of_squares = 0.0;
    for (int v = 10; v < 470; ++v) {
      for (int u = 10; u < 630; ++u) {
        const double error = frame.metres(u, v) - ramp(u, v);
        sum += error;
        sum_of_squares += error * error;
      }
    }
    const double pixels = 460.0 * 620.0;
    EXPECT_NEAR(sum / pixels, 0.0, 5e-5);
    EXPECT_NEAR(std::sqrt(sum_of_squares / pixels), 5e-3, 5e-5);
  }
}

TEST(LateralJitter, LeavesEdgesWhereTheyAreAndMixesNoDepths) {
  // A board of 200 px, whose edges sweep over a pixel; 0.5 m before a wall.
  double bias = 0.0;
  const int steps = 4;
  for (int step = 0; step < steps; ++step) {
    const double left = 200.0 + (step + 0.5) / steps;
    const DepthFrame frame = measured(
        sensor_model("primesense"),
        [left](double u, double) { return u > left && u < left + 200.0 ? 1.2 : 1.7; },
        static_cast<std::uint64_t>(step));
    double near_left = 0.0;
    double seen_left = 0.0;
    for (int v = 0; v < 480; ++v) {
      for (int u = 190; u <= 211; ++u) {
        const double z = frame.metres(u, v);
        ASSERT_TRUE(z == 0.0 || std::abs(z - 1.2) < 0.03 || std::abs(z - 1.7) < 0.06) << z;
        near_left += z > 0.0 && z < 1.45 ? 1.0 : 0.0;
        seen_left += z > 0.0 ? 1.0 : 0.0;
      }
    }
    // Of the 22 columns around it, those right of the edge are near: 211.5 - left. Drop-outs hit
    // both sides alike.
    bias += (near_left / seen_left * 22.0 - (211.5 - left)) / steps;
  }
  EXPECT_NEAR(bias, 0.0, 0.05);
}

TEST(DropOuts, TwoInAThousandOnAPlainWall) {
  const DepthFrame frame = measured(sensor_model("primesense"), flat_wall);
  EXPECT_NEAR(share_without_depth(frame, 0, 640), 0.002, 0.0006);
}

TEST(DropOuts, AQuarterNextToAnEdgeOnBothSidesAlike) {
  const auto step = [](double u, double) { return u < 319.75 ? 1.2 : 1.7; };
  const DepthFrame frame = measured(sensor_model("primesense"), step);
  EXPECT_NEAR(share_without_depth(frame, 319, 320), 0.25, 0.1);
  EXPECT_NEAR(share_without_depth(frame, 320, 321), 0.25, 0.1);
  EXPECT_LT(share_without_depth(frame, 300, 319), 0.006);
  EXPECT_LT(share_without_depth(frame, 321, 340), 0.006);
}

TEST(DropOuts, LowStepsAreNoEdges) {
  // 12 mm at 1.2 m are 0.36 px of disparity.
  const auto step = [](double u, double) { return u < 319.75 ? 1.2 : 1.212; };
  const DepthFrame frame = measured(sensor_model("primesense"), step);
  EXPECT_LT(share_without_depth(frame, 319, 321), 0.015);
}

TEST(DropOuts, GrowBeyond80DegreesOfIncidence) {
  EXPECT_LT(share_without_depth_at_incidence(75.0), 0.02);
  EXPECT_LT(share_without_depth_at_incidence(79.0), 0.02);
  // 1 - cos(85) / cos(80) = 0.498
  EXPECT_NEAR(share_without_depth_at_incidence(85.0), 0.5, 0.1);
}

TEST(StructuredLight, LosesTwoInAHundredPixelsAndMostAtEdges) {
  const SensorModel sensor = sensor_model("structured-light");
  EXPECT_NEAR(share_without_depth(measured(sensor, flat_wall), 0, 640), 0.02, 0.002);
  const auto step = [](double u, double) { return u < 319.5 ? 1.7 : 1.2; };
  const DepthFrame frame = measured(sensor, step);
  EXPECT_NEAR(share_without_depth(frame, 320, 321), 0.6, 0.1);  // the near side
  EXPECT_EQ(share_without_depth(frame, 312, 320), 1.0);         // 10.6 pixels in the shadow
  EXPECT_LT(share_without_depth(frame, 290, 308), 0.04);
}

TEST(Range, NearerAndFartherIsNotMeasured) {
  const SensorModel sensor = sensor_model("primesense");
  EXPECT_EQ(share_without_depth(measured(sensor, [](double, double) { return 0.38; }), 0, 640),
            1.0);
  EXPECT_LT(share_without_depth(measured(sensor, [](double, double) { return 0.42; }), 0, 640),
            0.01);
  EXPECT_LT(share_without_depth(measured(sensor, [](double, double) { return 4.2; }), 0, 640),
            0.01);
  EXPECT_EQ(share_without_depth(measured(sensor, [](double, double) { return 5.2; }), 0, 640), 1.0);
}

TEST(SensorSimulator, SameForAnyNumberOfThreadsAndOrderOfFrames) {
  const auto slope = [](double u, double v) { return 0.8 + 0.004 * u + 0.001 * v; };
  const SensorModel sensor = sensor_model("primesense");
  const DepthFrame reference = measured(sensor, slope, 5, 1);
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(measured(sensor, slope, 5, threads).depth, reference.depth) << threads;
  }
  SensorSimulator simulator(sensor, kSimulatedCamera, 1, Executor(2));
  const RenderedDepth clean = clean_depth(simulator, slope);
  DepthFrame frame;
  simulator.measure(clean, 9, frame);
  EXPECT_NE(frame.depth, reference.depth);
  simulator.measure(clean, 5, frame);
  EXPECT_EQ(frame.depth, reference.depth);
}

TEST(SensorSimulator, OtherSeedOtherNoise) {
  const SensorModel sensor = sensor_model("primesense");
  EXPECT_NE(measured(sensor, flat_wall, 0, 2, 1).depth, measured(sensor, flat_wall, 0, 2, 2).depth);
}

}  // namespace
}  // namespace lockbox
