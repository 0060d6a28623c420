// SPDX-License-Identifier: BSD-3-Clause
// The size of what was followed before says nothing of what is found later.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

/// As if everything were so many times as far away, and so as large.
DepthFrame times(double factor, DepthFrame frame) {
  for (auto& depth : frame.depth)
    depth = static_cast<std::uint16_t>(std::lround(factor * static_cast<double>(depth)));
  return frame;
}

TEST(SizeOfAnother, IsForgottenOnceTheObjectIsSoughtAnew) {
  constexpr double kTooFar = 1.1;
  const ArticulatedModel& model = mechanism();
  const Configuration truth = mechanism_start(model);
  Configuration another = truth;
  another.T_camera_base.translation() *= kTooFar;
  Configuration out_of_view = truth;
  out_of_view.T_camera_base.translation().x() += 5.0;

  TrackerOptions options;
  options.threads = 1;
  Tracker tracker(model, options);
  std::uint64_t seed = 0;
  const auto process = [&](const Configuration& configuration, double factor) {
    DepthFrame frame = times(factor, measured(model, configuration, "primesense", ++seed));
    frame.stamp = static_cast<double>(seed) / 30.0;
    return tracker.process(frame);
  };

  tracker.start(another);
  TrackingResult result;
  for (int i = 0; i < 6; ++i) result = process(truth, kTooFar);
  ASSERT_TRUE(result.size.is_implausible());
  while (result.status != TrackingStatus::lost && seed < 40) result = process(out_of_view, 1.0);
  ASSERT_EQ(result.status, TrackingStatus::lost);
  while (result.status == TrackingStatus::lost && seed < 60) result = process(truth, 1.0);
  EXPECT_EQ(result.status, TrackingStatus::tracking);
}

}  // namespace
}  // namespace lockbox
