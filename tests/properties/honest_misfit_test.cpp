// SPDX-License-Identifier: BSD-3-Clause
// Property "honest covariance" of objects that are not quite their models: what is reported covers
// the errors, though all tiles of a face err alike and no amount of them averages that away.
#include <gtest/gtest.h>

#include <cmath>

#include "initialization/seen_model.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/deviating_model.hpp"
#include "lockbox/simulation/simulator.hpp"

namespace lockbox {
namespace {

const PinholeCamera kVgaCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

struct Misfit {
  std::string name;
  ObjectDeviation deviation;
  double most_in_noise;  ///< errors that are larger than this many deviations of noise alone
};

void PrintTo(const Misfit& misfit, std::ostream* stream) {
  *stream << misfit.name;
}

class HonestMisfit : public ::testing::TestWithParam<Misfit> {
 protected:
  const ArticulatedModel& model_ = shipped("lockbox");

  RegistrationResult registered(const ObjectDeviation& deviation, const Configuration& truth) {
    const KinematicTree built = deviating_model(model_.tree, deviation, 3, Executor());
    State state;
    state.configuration = truth;
    Scene scene;
    scene.planes.push_back({SceneFrame::world, {0.0, 0.0, 2.2}, {0.0, 0.0, -1.0}, {8.0, 8.0}});
    Simulator simulator(built, kVgaCamera, PlacedScene(scene, {state}), sensor_model("primesense"),
                        5, Executor());
    DepthFrame frame;
    simulator.simulate(state, 0, frame);
    TiledCloud cloud;
    cloud.assign(frame, {}, Executor());
    ArticulatedRegistration registration(model_, {}, Executor());
    return registration.align(cloud, truth, {0.005, 12, false, 6});
  }

  Eigen::VectorXd error(const RegistrationResult& found, const Configuration& truth) const {
    Eigen::VectorXd off(found.sigma.size());
    off << log_se3(truth.T_camera_base.inverse() * found.configuration.T_camera_base),
        found.configuration.q - truth.q;
    for (Eigen::Index i = 0; i < off.size(); ++i) {
      if (!found.observable[static_cast<std::size_t>(i)]) off[i] = 0.0;
    }
    return off.cwiseAbs();
  }
};

TEST_P(HonestMisfit, IsCoveredByWhatIsReportedAndNotByNoise) {
  Configuration truth = *model_.parameters.initial_configuration;
  for (int v = 0; v < model_.tree.variables(); ++v) {
    const VariableLimits limits = variable_limits(model_.tree, v);
    const bool is_limited = std::isfinite(limits.upper - limits.lower);
    truth.q[v] = is_limited ? limits.lower + (limits.upper - limits.lower) / 3.0 : 0.7;
  }
  const RegistrationResult found = registered(GetParam().deviation, truth);
  const Eigen::VectorXd off = error(found, truth);
  EXPECT_LT(off.cwiseQuotient(found.sigma).maxCoeff(), 4.0);
  EXPECT_GT(off.cwiseQuotient(found.sigma_of_noise).maxCoeff(), GetParam().most_in_noise);
  const RegistrationResult exact = registered({}, truth);
  EXPECT_LT(exact.sigma.head<3>().norm(), 0.3 * found.sigma.head<3>().norm())
      << "of the model itself";
}

INSTANTIATE_TEST_SUITE_P(
    Of, HonestMisfit,
    ::testing::Values(Misfit{"scale", {.scale = 1.01}, 6.0},
                      Misfit{"axes", {.joint_origins = 0.003, .joint_axes = 0.009}, 6.0}),
    [](const ::testing::TestParamInfo<Misfit>& misfit) { return misfit.param.name; });

}  // namespace
}  // namespace lockbox
