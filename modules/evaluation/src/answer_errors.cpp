// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/answer_errors.hpp"

#include <cmath>
#include <limits>

#include "lockbox/core/units.hpp"
#include "lockbox/model/symmetry.hpp"

namespace lockbox {
namespace {

constexpr double kDeterminedJoint = 0.1;  // of the tolerance: 1 mm, half a degree

}  // namespace

bool determines_base(const Eigen::VectorXd& bound) {
  return bound.head<3>().norm() < 0.005 && bound.segment<3>(3).norm() < 0.5 * kRadians;
}

AnswerComparison::AnswerComparison(const ArticulatedModel& model, const Tolerances& tolerances)
    : model_(model), tolerances_(tolerances), symmetries_(find_lasting_symmetries(model)) {
  for (int v = 0; v < model.tree.variables(); ++v) {
    joint_turns_.push_back(count_joint_turns(model, v));
  }
}

State AnswerComparison::nearest_truth(State truth, const Configuration& answer) const {
  Eigen::VectorXd& q = truth.configuration.q;
  if (answer.q.size() != q.size()) return truth;
  for (Eigen::Index v = 0; v < q.size(); ++v) {
    const int turns = joint_turns_[static_cast<std::size_t>(v)];
    if (turns == 1) continue;
    const double part = kFullTurn / turns;
    q[v] += part * std::round((answer.q[v] - q[v]) / part);
  }
  return truth;
}

AnswerErrors AnswerComparison::compare(const TrackingResult& answer, const State& true_state,
                                       const Eigen::VectorXd& bound) const {
  AnswerErrors errors;
  const State truth = nearest_truth(true_state, answer.configuration);
  errors.outcome = lockbox::compare(model_.tree, answer, truth);
  if (std::isnan(errors.outcome.translation)) {
    errors.wrong = "nothing";
    return errors;
  }
  for (const Eigen::Isometry3d& symmetry : symmetries_) {
    State equal = truth;
    equal.configuration.T_camera_base = truth.configuration.T_camera_base * symmetry;
    const FrameOutcome outcome = lockbox::compare(model_.tree, answer, equal);
    if (outcome.rotation < errors.outcome.rotation) errors.outcome = outcome;
  }
  const bool base_is_right = errors.outcome.translation < tolerances_.translation &&
                             errors.outcome.rotation < tolerances_.rotation;
  errors.wrong = base_is_right ? wrong_joints(answer.configuration, truth, bound) : "base";
  return errors;
}

std::string AnswerComparison::wrong_joints(const Configuration& answer, const State& truth,
                                           const Eigen::VectorXd& bound) const {
  std::string wrong;
  for (std::size_t j = 0; j < model_.tree.joints.size(); ++j) {
    const Joint& joint = model_.tree.joints[j];
    const int index = static_cast<int>(j);
    double error = joint_position(model_.tree, answer, index) -
                   joint_position(model_.tree, truth.configuration, index);
    if (joint.type == JointType::continuous) error = std::remainder(error, kFullTurn);
    const double tolerance = tolerances_.joint(joint.type);
    const double sigma = std::abs(joint.multiplier) * bound(unknown_of(joint.variable));
    if (sigma < kDeterminedJoint * tolerance && std::abs(error) > tolerance) {
      wrong += (wrong.empty() ? "" : " ") + joint.name;
    }
  }
  return wrong;
}

}  // namespace lockbox
