// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/global_experiment.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/random_frame.hpp"
#include "lockbox/model/symmetry.hpp"

namespace lockbox {
namespace {

bool determines_base(const Eigen::VectorXd& bound) {
  return bound.head<3>().norm() < 0.005 && bound.segment<3>(3).norm() < 0.5 * kRadians;
}

}  // namespace

GlobalExperiment::GlobalExperiment(const ArticulatedModel& model, const PinholeCamera& camera,
                                   const SensorModel& sensor, std::uint64_t seed,
                                   const Executor& executor)
    : model_(model),
      camera_(camera),
      sensor_(sensor),
      seed_(seed),
      executor_(executor),
      registration_(model, options_.registration, executor_),
      acquisition_(model, options_, executor_, registration_, cloud_),
      symmetries_(find_symmetries(model)) {
  acquisition_.prepare();
}

GlobalResult GlobalExperiment::search_scene(std::uint64_t number) {
  const RandomFrame seen =
      simulate_random_frame(model_, camera_, sensor_, seed_, number, executor_);
  const RandomScene& drawn = seen.view;
  GlobalResult result;
  result.scene = number;
  result.placement = drawn.placement;
  result.cut_off = drawn.cut_off;
  result.visible = drawn.visible;
  result.distance = drawn.truth.configuration.T_camera_base.translation().norm();
  result.determined = determines_base(seen.bound);
  const auto began = std::chrono::steady_clock::now();
  cloud_.assign(seen.frame, options_.cloud, executor_);
  const auto found = acquisition_.find(seen.frame, std::nullopt, SearchScope::anywhere);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (found) {
    compare_with_truth(*found, drawn.truth, seen.bound, result);
  } else {
    result.wrong = "nothing";
    result.translation = result.rotation = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

void GlobalExperiment::compare_with_truth(const RegistrationResult& found, const State& truth,
                                          const Eigen::VectorXd& bound,
                                          GlobalResult& result) const {
  result.explained = found.agreement.explained;
  result.contradicted = found.agreement.contradicted;
  result.status = judge(found, options_);
  TrackingResult answer;
  answer.status = result.status;
  answer.configuration = found.configuration;
  answer.observable = known_unknowns(found, model_.tree, options_);
  result.rotation = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& symmetry : symmetries_) {
    State equal = truth;
    equal.configuration.T_camera_base = truth.configuration.T_camera_base * symmetry;
    const FrameOutcome outcome = compare(model_.tree, answer, equal);
    if (outcome.rotation >= result.rotation) continue;
    result.rotation = outcome.rotation;
    result.translation = outcome.translation;
    result.within = outcome.is_right();
  }
  result.wrong = wrong_unknowns(found.configuration, truth, bound, result);
  result.right = result.wrong.empty();
}

std::string GlobalExperiment::wrong_unknowns(const Configuration& found, const State& truth,
                                             const Eigen::VectorXd& bound,
                                             const GlobalResult& result) const {
  if (!(result.translation < 0.01 && result.rotation < 1.0 * kRadians)) return "base";
  std::string wrong;
  for (std::size_t j = 0; j < model_.tree.joints.size(); ++j) {
    const Joint& joint = model_.tree.joints[j];
    const bool slides = joint.type == JointType::prismatic;
    const int index = static_cast<int>(j);
    double error = joint_position(model_.tree, found, index) -
                   joint_position(model_.tree, truth.configuration, index);
    if (joint.type == JointType::continuous) error = std::remainder(error, kFullTurn);
    const double sigma = std::abs(joint.multiplier) * bound(6 + joint.variable);
    const bool determined = sigma < (slides ? 0.001 : 0.5 * kRadians);
    if (determined && std::abs(error) > (slides ? 0.01 : 5.0 * kRadians)) {
      wrong += (wrong.empty() ? "" : " ") + joint.name;
    }
  }
  return wrong;
}

}  // namespace lockbox
