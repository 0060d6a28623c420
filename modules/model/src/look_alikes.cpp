// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/look_alikes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/symmetry.hpp"

namespace lockbox {
namespace {

/// Configurations. Unit: 1. Source: a square foot has up to seven, of which one makes the base
/// uncertain. Doubled, it takes twice as long.
constexpr std::size_t kMost = 8;
/// Positions that are tried for a pose of the base. Unit: 1, of some microseconds. Source: an arm
/// of twenty square links takes some hundred; round links that turn about their own axes have 24
/// each. Doubled, a tracker waits for that twice as long.
constexpr int kMostTrials = 5000;
/// That a body may be off and look the same. Unit: metres, radians. Source: symmetries are found to
/// half a millimetre and turns of a centimetre that are seen. Doubled, what is a millimetre off
/// axis is a look-alike as well.
constexpr double kSamePlace = 0.001;
constexpr double kSameTurn = 0.5 * kRadians;

bool are_same(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d move = a.inverse() * b;
  return move.translation().norm() < kSamePlace && log_so3(move.linear()).norm() < kSameTurn;
}

/// Returns the position at which the joint makes that motion, if there is one.
std::optional<double> position_of(const Joint& joint, const Eigen::Isometry3d& motion) {
  const Eigen::Vector3d turn = log_so3(motion.linear());
  if (joint.type == JointType::prismatic) {
    const double position = motion.translation().dot(joint.axis);
    const bool is_shift = turn.norm() < kSameTurn &&
                          (motion.translation() - position * joint.axis).norm() < kSamePlace;
    return is_shift ? std::optional(position) : std::nullopt;
  }
  // By the axis that it turns about: near half a turn a logarithm has either sign.
  const Eigen::Quaterniond q(motion.linear());
  const double position = 2.0 * std::atan2(q.vec().dot(joint.axis), q.w());
  const Eigen::Matrix3d rest =
      Eigen::AngleAxisd(-position, joint.axis).toRotationMatrix() * motion.linear();
  const bool is_turn = log_so3(rest).norm() < kSameTurn && motion.translation().norm() < kSamePlace;
  return is_turn ? std::optional(position) : std::nullopt;
}

/// Puts the joints, parents first, where all that they carry looks as it does.
class Placement {
 public:
  Placement(const KinematicTree& tree, const std::vector<bool>& locked,
            const std::vector<std::vector<Eigen::Isometry3d>>& symmetries, const BodyPoses& seen)
      : tree_(tree), locked_(locked), symmetries_(symmetries), seen_(seen) {}

  /// Appends what there is for that pose of the base, until there are kMost. with_same: also where
  /// all other bodies are where they were.
  void find(Configuration turned, bool with_same, std::vector<Configuration>& found) {
    trials_ = 0;
    Attempt attempt{std::move(turned), seen_,
                    std::vector<bool>(static_cast<std::size_t>(tree_.variables()), false), true};
    attempt.poses[0] = attempt.configuration.T_camera_base;
    put(0, attempt, with_same, found);
  }

 private:
  struct Attempt {
    Configuration configuration;
    BodyPoses poses;
    std::vector<bool> is_set;  ///< by variable
    bool others_are_same;      ///< all bodies but the base are where they were
  };

  /// Depth first: a joint whose parent was turned hardly ever has more than one such position.
  void put(std::size_t number, const Attempt& attempt, bool with_same,
           std::vector<Configuration>& found) {
    if (found.size() == kMost || trials_ >= kMostTrials) return;
    if (number == tree_.joints.size()) {
      if (with_same || !attempt.others_are_same) found.push_back(attempt.configuration);
      return;
    }
    const Joint& joint = tree_.joints[number];
    const auto child = static_cast<std::size_t>(joint.child_body);
    const Eigen::Isometry3d T_camera_joint =
        attempt.poses[static_cast<std::size_t>(joint.parent_body)] * joint.T_parent_joint;
    for (const Eigen::Isometry3d& symmetry : symmetries_[child]) {
      const Eigen::Isometry3d there = seen_[child] * symmetry;
      const auto position = position_of(joint, T_camera_joint.inverse() * there);
      if (++trials_ > kMostTrials) return;
      if (!position) continue;
      Attempt next = attempt;
      if (!set_variable(joint, *position, next)) continue;
      next.poses[child] = there;
      next.others_are_same = attempt.others_are_same && are_same(there, seen_[child]);
      put(number + 1, next, with_same, found);
    }
  }

  /// Whether it can be there: within its limits, and where it was if it is locked, or was set by
  /// another joint.
  bool set_variable(const Joint& joint, double position, Attempt& attempt) const {
    const auto v = static_cast<std::size_t>(joint.variable);
    const VariableLimits limits = variable_limits(tree_, joint.variable);
    const bool is_shift = joint.type == JointType::prismatic;
    double& q = attempt.configuration.q[joint.variable];
    double value = (position - joint.offset) / joint.multiplier;
    if (!is_shift) {
      // Of whole turns, which look the same, the one in the middle of the range.
      const double middle = 0.5 * (limits.lower + limits.upper);
      const double near = std::isfinite(middle) ? middle : q;
      value = near + std::remainder(value - near, kFullTurn / joint.multiplier);
    }
    const double slack = is_shift ? kSamePlace : kSameTurn;
    if (value < limits.lower - slack || value > limits.upper + slack) return false;
    const bool is_given = attempt.is_set[v] || (v < locked_.size() && locked_[v]);
    if (is_given && std::abs(value - q) > slack) return false;
    if (!is_given) q = std::clamp(value, limits.lower, limits.upper);
    attempt.is_set[v] = true;
    return true;
  }

  const KinematicTree& tree_;
  const std::vector<bool>& locked_;
  const std::vector<std::vector<Eigen::Isometry3d>>& symmetries_;
  const BodyPoses& seen_;
  int trials_ = 0;
};

}  // namespace

LookAlikes::LookAlikes(const ArticulatedModel& model, std::vector<bool> locked)
    : model_(model), locked_(std::move(locked)) {
  if (model.tree.variables() == 0) return;
  const std::vector<Eigen::Isometry3d> lasting = find_lasting_symmetries(model);
  turns_ = find_body_symmetries(model, 0);
  std::erase_if(turns_, [&](const Eigen::Isometry3d& turn) {
    return std::any_of(lasting.begin(), lasting.end(),
                       [&](const Eigen::Isometry3d& same) { return are_same(turn, same); });
  });
  for (std::size_t b = 0; b < model.tree.bodies.size() && !turns_.empty(); ++b) {
    symmetries_.push_back(find_body_symmetries(model, b));
  }
}

std::vector<Configuration> LookAlikes::of(const Configuration& configuration) const {
  BodyPoses seen;
  forward_kinematics(model_.tree, configuration, seen);
  Placement placement(model_.tree, locked_, symmetries_, seen);
  std::vector<Configuration> found;
  for (const Eigen::Isometry3d& turn : turns_) {
    Configuration turned = configuration;
    turned.T_camera_base = configuration.T_camera_base * turn;
    placement.find(std::move(turned), !is_turn_of_round_base(turn), found);
  }
  return found;
}

bool LookAlikes::is_turn_of_round_base(const Eigen::Isometry3d& turn) const {
  if (model_.round_axes.size() > 1) return true;  // of a ball, any
  return std::any_of(model_.round_axes.begin(), model_.round_axes.end(),
                     [&](const Eigen::Vector3d& axis) {
                       return (turn.linear() * axis).dot(axis) > std::cos(kSameTurn);
                     });
}

}  // namespace lockbox
