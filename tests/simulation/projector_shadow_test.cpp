// SPDX-License-Identifier: BSD-3-Clause
// What the projector does not reach, because something stands before it.
#include <gtest/gtest.h>

#include <set>

#include "lockbox/simulation/sensor_simulator.hpp"
#include "measured_frame.hpp"

namespace lockbox {
namespace {

SensorModel shadow_only(double jitter) {
  SensorModel sensor = sensor_model("ideal");
  sensor.has_projector_shadow = true;
  sensor.lateral_jitter = jitter;
  return sensor;
}

// A board before a wall: disparities of 54 and 36 pixels (z = 0.7997 and 1.1996 m).
double board_before_wall(double u, double begin, double end) {
  return kSimulatedCamera.fx * 0.075 / (u > begin && u < end ? 54.0 : 36.0);
}

TEST(ProjectorShadow, IsAsWideAsTheDisparitiesDifferAndLiesLeftOfWhatCastsIt) {
  const auto board = [](double u, double) { return board_before_wall(u, 299.5, 400.5); };
  const auto hidden = unmeasured_columns(measured(shadow_only(0.0), board));
  ASSERT_EQ(hidden.size(), 18U);
  EXPECT_EQ(*hidden.begin(), 282);
  EXPECT_EQ(*hidden.rbegin(), 299);
}

TEST(ProjectorShadow, OfSomethingNarrowLiesApartFromIt) {
  // Five columns, whose projector columns are those of the wall 18 pixels further left.
  const auto pole = [](double u, double) { return board_before_wall(u, 299.5, 304.5); };
  EXPECT_EQ(unmeasured_columns(measured(shadow_only(0.0), pole)),
            (std::set<int>{282, 283, 284, 285, 286}));
}

TEST(ProjectorShadow, SlopesCastNoneOnThemselves) {
  for (const double growth : {-0.0012, 0.0012}) {
    const auto slope = [growth](double u, double) { return 1.2 + growth * (u - 320.0); };
    EXPECT_TRUE(unmeasured_columns(measured(shadow_only(0.0), slope)).empty()) << growth;
  }
}

TEST(ProjectorShadow, IsThereUnderLateralJitter) {
  const auto board = [](double u, double) { return board_before_wall(u, 299.5, 400.5); };
  const auto hidden = unmeasured_columns(measured(shadow_only(0.5), board));
  for (int u = 285; u < 297; ++u) EXPECT_EQ(hidden.count(u), 1U) << u;
  for (int u = 305; u < 640; ++u) EXPECT_EQ(hidden.count(u), 0U) << u;
}

}  // namespace
}  // namespace lockbox
