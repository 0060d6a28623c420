// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/sensor_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

const PinholeCamera kCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

TEST(SensorModel, UnknownNameIsRefusedWithTheChoices) {
  try {
    sensor_model("kinect");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("kinect"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("primesense-quiet"));
  }
}

TEST(SensorModel, NamesAreKept) {
  for (const char* name : {"primesense", "primesense-quiet", "structured-light", "stereo",
                           "time-of-flight", "time-of-flight-biased", "white", "ideal"}) {
    EXPECT_EQ(sensor_model(name).name, name);
  }
}

// At 1.2 m a pixel of disparity is 1.44 / (575.8 * 0.075) = 33.34 mm; 0.08 px of noise and 1/8 px
// steps (0.0361 px) make 0.0878 px, that is 2.926 mm; the millimetre adds 0.289 mm.
TEST(SensorModel, DepthSigmaOfPrimesenseAtATypicalDistance) {
  EXPECT_NEAR(depth_sigma(sensor_model("primesense"), kCamera, 1.2), 2.941e-3, 2e-6);
}

TEST(SensorModel, DepthSigmaOfWhiteGrowsWithTheSquare) {
  // 1.2 mm + 1.9 mm * 1.6^2 = 6.064 mm at 2 m.
  EXPECT_NEAR(depth_sigma(sensor_model("white"), kCamera, 2.0), 6.071e-3, 2e-6);
}

TEST(SensorModel, CorrelationKernelKeepsTheVariance) {
  for (const char* name : {"primesense", "white"}) {
    const auto kernel = correlation_kernel(sensor_model(name));
    EXPECT_EQ(kernel.size() % 2, 1U);
    EXPECT_NEAR(std::inner_product(kernel.begin(), kernel.end(), kernel.begin(), 0.0), 1.0, 1e-6);
  }
}

TEST(SensorModel, CorrelationAreaIsTheIntegralOfTheAutocorrelation) {
  // The integral of exp(-r^2 / (2 * 3^2)) over the plane; the filter is cut off at 3 deviations.
  EXPECT_NEAR(correlation_area(sensor_model("primesense")), 2.0 * std::numbers::pi * 9.0, 0.5);
  EXPECT_NEAR(correlation_area(sensor_model("white")), 1.0, 1e-6);
}

}  // namespace
}  // namespace lockbox
