// SPDX-License-Identifier: BSD-3-Clause
// Joints that an alignment drags along while the base goes far.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "initialization/seen_model.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

/// The box is turned by 17 degrees and moved by 10 cm while the camera is covered. On the way back
/// to it the slider was left 11 mm from its end, at rest, while other parts had to be sought.
TEST(DraggedJoint, IsSoughtWhereItBelongs) {
  const ArticulatedModel& model = shipped("lockbox");
  State before;
  before.configuration = *model.parameters.initial_configuration;
  State after = before;
  after.stamp = 1.0;
  after.configuration.T_camera_base =
      Eigen::Translation3d(0.065179, 0.038361, 1.180216) *
      Eigen::Quaterniond(-0.021097, 0.975710, -0.020772, -0.217057).normalized();
  const SensorModel sensor = sensor_model("primesense");
  const Scene room = read_scene(std::string(LOCKBOX_MODELS) + "/../scenes/room.yaml");
  Simulator simulator(model.tree, sensor.camera, PlacedScene(room, {before, after}), sensor, 1,
                      Executor(2));
  Tracker tracker(model, {});
  tracker.start(before.configuration);
  DepthFrame frame;
  simulator.simulate(before, 9, frame);
  ASSERT_EQ(tracker.process(frame).status, TrackingStatus::tracking);
  DepthFrame covered = frame;
  covered.stamp = 0.5;
  std::fill(covered.depth.begin(), covered.depth.end(), std::uint16_t{0});
  tracker.process(covered);
  simulator.simulate(after, 40, frame);
  const TrackingResult& found = tracker.process(frame);
  ASSERT_EQ(found.status, TrackingStatus::tracking);
  const int slider = joint_index(model.tree, "slider");
  EXPECT_NEAR(joint_position(model.tree, found.configuration, slider), 0.0, 0.005);
}

}  // namespace
}  // namespace lockbox
