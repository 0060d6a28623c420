// SPDX-License-Identifier: BSD-3-Clause
// Property "apparent size": how large an object looks beside its model is found out, both ways, and
// whether it is its scale or the focal length where its relief tells.
#include <gtest/gtest.h>

#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/simulator.hpp"

namespace lockbox {
namespace {

const PinholeCamera kCameraOfSize{640, 480, 575.8, 575.8, 319.5, 239.5};

struct Look {
  std::string model;
  double scale = 1.0;  ///< of the object
  double focal = 1.0;  ///< of the camera, as a multiple of its calibration
  double depth = 1.0;  ///< of the depths
};

void PrintTo(const Look& look, std::ostream* stream) {
  *stream << look.model << " scale " << look.scale << " focal " << look.focal << " depth "
          << look.depth;
}

/// What is seen of a look, aligned with the model, and what it was.
struct SeenSize {
  SizeMeasurement size;
  Eigen::VectorXd error;  ///< of (base twist, variables)
};

class ApparentSizeProperty : public ::testing::TestWithParam<Look> {
 protected:
  SeenSize measured(const Look& look) {
    const ArticulatedModel& model = shipped(look.model);
    const KinematicTree built = deviating_model(model.tree, {.scale = look.scale}, 3, Executor());
    State state;
    state.configuration = *model.parameters.initial_configuration;
    const Eigen::Isometry3d& T = state.configuration.T_camera_base;
    Scene scene;
    scene.planes.push_back(
        {SceneFrame::world, {0.0, 0.0, T.translation().z() + 1.0}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
    SensorDeviation deviation;
    deviation.camera.focal_length = look.focal;
    deviation.depth.scale = look.depth;
    Simulator simulator(built, kCameraOfSize, PlacedScene(scene, {state}),
                        sensor_model("primesense"), 61, Executor(), deviation);
    DepthFrame frame;
    simulator.simulate(state, 0, frame);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor());
    ArticulatedRegistration registration(model, {}, Executor());
    Configuration start = state.configuration;
    start.T_camera_base = simulator.apparent_base();
    const RegistrationResult& found = registration.align(cloud, start, {0.005, 12, false, 6});
    Eigen::VectorXd error(found.sigma.size());
    error << log_se3(start.T_camera_base.inverse() * found.configuration.T_camera_base),
        found.configuration.q - start.q;
    return {registration.measure_size(cloud, found.configuration), error};
  }
};

TEST_P(ApparentSizeProperty, IsFoundOutWithItsDeviation) {
  const Look& look = GetParam();
  const SizeMeasurement size = measured(look).size;
  const double along = look.scale * look.depth;
  const double across = along * look.focal;
  const Eigen::Vector2d sigma = size.covariance.diagonal().cwiseSqrt();
  EXPECT_NEAR(size.value[0], across, 0.005);
  EXPECT_NEAR(size.value[0], across, 4.0 * sigma[0] + 0.02 * std::abs(across - 1.0));
  EXPECT_LT(sigma[0], 0.005);
  EXPECT_NEAR(size.value[1], along, 4.0 * sigma[1] + 0.02 * std::abs(across - 1.0));
}

/// Where the size is off by as much as objects and cameras are; beyond, gates lose what is too far.
class MisleadingSize : public ApparentSizeProperty {};

TEST_P(MisleadingSize, PutsTheBaseElsewhereAsFarAsIsSaid) {
  const auto [size, error] = measured(GetParam());
  const Eigen::Vector3d said = size.effect.topRows<3>() * (size.value - Eigen::Vector2d::Ones());
  const Eigen::Vector3d off = error.head<3>();
  EXPECT_GT(off.norm(), 0.003);
  EXPECT_GT(said.norm(), 0.5 * off.norm());
  EXPECT_LT(said.norm(), 2.0 * off.norm());
  EXPECT_GT(said.dot(off), 0.5 * said.norm() * off.norm());
}

INSTANTIATE_TEST_SUITE_P(Of, ApparentSizeProperty,
                         ::testing::Values(Look{"rigid_block"}, Look{"rigid_block", 0.95},
                                           Look{"rigid_block", 0.98}, Look{"rigid_block", 1.02},
                                           Look{"rigid_block", 1.05}, Look{"rigid_block", 0.9},
                                           Look{"rigid_block", 1.0, 0.95},
                                           Look{"rigid_block", 1.0, 1.05},
                                           Look{"rigid_block", 1.0, 1.0, 1.05}, Look{"cabinet"},
                                           Look{"cabinet", 0.98}, Look{"cabinet", 1.02},
                                           Look{"cabinet", 1.0, 1.02}));

INSTANTIATE_TEST_SUITE_P(Of, MisleadingSize,
                         ::testing::Values(Look{"rigid_block", 0.98}, Look{"rigid_block", 1.02},
                                           Look{"cabinet", 0.98}, Look{"cabinet", 1.02},
                                           Look{"cabinet", 1.0, 1.02}, Look{"lockbox", 0.985},
                                           Look{"lockbox", 1.01}));

}  // namespace
}  // namespace lockbox
