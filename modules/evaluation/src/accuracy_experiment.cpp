// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/accuracy_experiment.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/random_frame.hpp"
#include "lockbox/evaluation/unknowns.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox {
namespace {

constexpr double kStartOffset = 0.005;  // metres
constexpr double kStartTurn = 1.0 * kRadians;
constexpr int kMostIterations = 30;  // it rests after about ten
constexpr int kNarrowing = 6;

}  // namespace

double allowed_error(const KinematicTree& tree, int unknown, double bound) {
  const bool base = unknown < kBaseUnknowns;
  const double floor =
      is_length(tree, unknown) ? (base ? 0.05e-3 : 0.15e-3) : (base ? 0.005 : 0.1) * kRadians;
  return std::hypot(1.5 * bound, floor);
}

bool is_told(const KinematicTree& tree, int unknown, double bound) {
  return bound < (is_length(tree, unknown) ? 0.005 : 2.0 * kRadians);
}

AccuracyExperiment::AccuracyExperiment(const ArticulatedModel& model, const PinholeCamera& camera,
                                       const SensorModel& sensor, std::uint64_t seed,
                                       const RegistrationOptions& options, const Executor& executor)
    : model_(model),
      camera_(camera),
      sensor_(sensor),
      seed_(seed),
      executor_(executor),
      registration_(model, options, executor) {}

Configuration AccuracyExperiment::wrong_start(const Configuration& truth,
                                              std::uint64_t number) const {
  RandomDraws random(~seed_, number);
  const KinematicTree& tree = model_.tree;
  Eigen::VectorXd step(tree.unknowns());
  step.head<3>() = random.uniform(0.0, kStartOffset) * random.direction();
  step.segment<3>(3) = random.uniform(0.0, kStartTurn) * random.direction();
  for (int v = 0; v < tree.variables(); ++v) {
    const double most = is_length(tree, unknown_of(v)) ? kStartOffset : kStartTurn;
    const VariableLimits limits = variable_limits(tree, v);
    const double start = truth.q[v] + random.uniform(-most, most);
    step[unknown_of(v)] = std::clamp(start, limits.lower, limits.upper) - truth.q[v];
  }
  return stepped(truth, step);
}

std::vector<UnknownError> AccuracyExperiment::align_frame(std::uint64_t number) {
  const RandomFrame seen =
      simulate_random_frame(model_, camera_, sensor_, seed_, number, executor_);
  const Configuration& truth = seen.view.truth.configuration;
  TiledCloud cloud;
  cloud.assign(seen.frame, {}, executor_);
  const RegistrationResult& found = registration_.align(
      cloud, wrong_start(truth, number), {kStartOffset, kMostIterations, false, kNarrowing});

  Eigen::VectorXd errors(seen.bound.size());
  errors.head<6>() = log_se3(truth.T_camera_base.inverse() * found.configuration.T_camera_base);
  errors.tail(truth.q.size()) = found.configuration.q - truth.q;
  std::vector<UnknownError> result;
  for (int i = 0; i < errors.size(); ++i) {
    const double error =
        is_length(model_.tree, i) ? errors[i] : std::remainder(errors[i], kFullTurn);
    result.push_back(
        {error, found.sigma[i], found.observable[static_cast<std::size_t>(i)], seen.bound[i]});
  }
  return result;
}

}  // namespace lockbox
