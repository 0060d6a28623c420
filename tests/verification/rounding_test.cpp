// SPDX-License-Identifier: BSD-3-Clause
// Steps of a sensor's resolution, centimetres wide some metres away, are no contours.
#include <gtest/gtest.h>

#include "evaluation/rigid_model.hpp"
#include "initialization/seen_model.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/sensor/sensor_profile.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/verification/belief.hpp"
#include "lockbox/verification/verifier.hpp"

namespace lockbox {
namespace {

/// Metres to the box.
class Rounding : public ::testing::TestWithParam<double> {};

/// Of this sensor rounding is most of the noise: between two steps all cells are alike. The box is
/// turned so that its sides and the wall have many of them.
TEST_P(Rounding, StepsOfWhatASensorResolvesDoNotContradictABox) {
  const KinematicTree box = rigid_tree(make_box({1.2, 0.8, 0.6}));
  State state;
  state.configuration = rest_configuration(box);
  state.configuration.T_camera_base = Eigen::Translation3d(0.0, 0.0, GetParam()) *
                                      Eigen::AngleAxisd(-2.2, Eigen::Vector3d::UnitX()) *
                                      Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ());
  const SensorProfile profile = find_sensor_profile("primesense-quiet");
  const SensorModel sensor = sensor_model(profile.name);
  DepthFrame frame;
  Simulator(box, sensor.camera, {wall_behind(1.5), {state}}, sensor, 5, Executor())
      .simulate(state, 0, frame);
  TiledCloud cloud;
  cloud.assign(frame, {}, Executor());
  Verifier verifier(box);
  verifier.look_at(cloud, profile.noise, Executor());
  const Evidence evidence = verifier.evidence(state.configuration);
  EXPECT_GT(evidence.total(), least_evidence());
  EXPECT_LT(-evidence.contradicted, 0.2 * evidence.matched);
}

INSTANTIATE_TEST_SUITE_P(Metres, Rounding, ::testing::Values(2.0, 2.5, 3.0, 3.5));

}  // namespace
}  // namespace lockbox
