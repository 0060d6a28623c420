// SPDX-License-Identifier: BSD-3-Clause
// What is so small, or so far away, that noise turns it by degrees.
#include <gtest/gtest.h>

#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/trajectory.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "mechanism.hpp"

namespace lockbox {
namespace {

struct Turned {
  const char* geometry;
  double distance;  ///< metres
  TrackingStatus status;
};

class Turning : public ::testing::TestWithParam<Turned> {};

/// It is followed as well as ever.
TEST_P(Turning, IsTrustedWhereItIsToldOrChangesNothing) {
  const std::string link = std::string("<link name='part'><visual><geometry>") +
                           GetParam().geometry + "</geometry></visual></link>";
  const ArticulatedModel model = load_mechanism({link}, {});
  Configuration truth = rest_configuration(model.tree);
  truth.T_camera_base =
      facing_pose(GetParam().distance) * Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.6, 0.8, 0.0));
  TrackerOptions options;
  options.threads = 1;
  Tracker tracker(model, options);
  tracker.start(truth);
  for (std::uint64_t number = 0; number < 3; ++number) {
    DepthFrame frame = seen_frame(model, truth, wall_behind(GetParam().distance), number);
    frame.stamp = static_cast<double>(number) / 30.0;
    const TrackingResult& result = tracker.process(frame);
    EXPECT_EQ(result.status, GetParam().status) << number;
    const Eigen::Vector3d off =
        result.configuration.T_camera_base.translation() - truth.T_camera_base.translation();
    EXPECT_LT(off.norm(), 0.01) << number;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Parts, Turning,
    ::testing::Values(Turned{"<box size='0.1 0.03 0.03'/>", 0.6, TrackingStatus::tracking},
                      Turned{"<box size='0.1 0.03 0.03'/>", 1.8, TrackingStatus::uncertain},
                      Turned{"<cylinder radius='0.04' length='0.13'/>", 0.8,
                             TrackingStatus::tracking}));

}  // namespace
}  // namespace lockbox
