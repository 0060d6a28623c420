// SPDX-License-Identifier: BSD-3-Clause
// Sensors of few pixels err alike over as many of them as others, and so over more of the image.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "evaluation/rigid_model.hpp"
#include "initialization/seen_model.hpp"
#include "lockbox/mesh/primitives.hpp"
#include "lockbox/sensor/sensor_profile.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/verification/belief.hpp"
#include "lockbox/verification/verifier.hpp"

namespace lockbox {
namespace {

/// Columns of the image, and the name of the sensor.
class ImageSize : public ::testing::TestWithParam<std::tuple<int, std::string>> {};

/// Its sides are slanted, so that noise, and steps of what a sensor resolves, lie across them.
TEST_P(ImageSize, ABoxBeforeAWallIsNotContradictedByNoise) {
  const auto& [columns, name] = GetParam();
  const double scale = columns / 640.0;
  const int rows = columns * 3 / 4;
  const PinholeCamera camera{
      columns, rows, 575.8 * scale, 575.8 * scale, 0.5 * (columns - 1), 0.5 * (rows - 1)};
  const KinematicTree box = rigid_tree(make_box({0.3, 0.2, 0.15}));
  const SensorProfile profile = find_sensor_profile(name);
  for (const double distance : {0.6, 0.9}) {
    State state;
    state.configuration = rest_configuration(box);
    state.configuration.T_camera_base = Eigen::Translation3d(0.0, 0.0, distance) *
                                        Eigen::AngleAxisd(-2.2, Eigen::Vector3d::UnitX()) *
                                        Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ());
    DepthFrame frame;
    Simulator(box, camera, {wall_behind(0.4), {state}}, sensor_model(name), 5, Executor())
        .simulate(state, 0, frame);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor());
    Verifier verifier(box);
    verifier.look_at(cloud, profile.noise, Executor());
    EXPECT_GT(verifier.evidence(state.configuration).total(), least_evidence()) << distance << " m";
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, ImageSize,
                         ::testing::Combine(::testing::Values(224, 320, 424, 640, 1280),
                                            ::testing::Values("primesense", "time-of-flight",
                                                              "white")),
                         [](const auto& tested) {
                           std::string name = std::get<1>(tested.param);
                           std::erase(name, '-');
                           return name + std::to_string(std::get<0>(tested.param));
                         });

}  // namespace
}  // namespace lockbox
