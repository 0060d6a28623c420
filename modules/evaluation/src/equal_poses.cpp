// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/equal_poses.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/tolerances.hpp"
#include "lockbox/model/symmetry.hpp"

namespace lockbox {
namespace {

constexpr double kSameTurn = 5.0 * kRadians;  // turns that are looked for differ by 15 degrees
constexpr std::size_t kAllTurns = 23;         // by 15 to 345 degrees

/// The turns about one axis that map a model onto itself.
struct Axis {
  Eigen::Vector3d direction;
  std::size_t turns = 0;
  double least = std::numeric_limits<double>::infinity();  ///< radians
};

bool are_parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::abs(a.dot(b)) > std::cos(kSameTurn);
}

std::vector<Axis> axes_of(const std::vector<Eigen::Isometry3d>& motions) {
  std::vector<Axis> axes;
  for (const auto& motion : motions) {
    const Eigen::AngleAxisd turn(motion.linear());
    if (turn.angle() < kSameTurn) continue;
    auto axis = std::find_if(axes.begin(), axes.end(), [&](const Axis& known) {
      return are_parallel(known.direction, turn.axis());
    });
    if (axis == axes.end()) axis = axes.insert(axes.end(), {turn.axis()});
    ++axis->turns;
    axis->least = std::min(axis->least, turn.angle());
  }
  return axes;
}

/// "x", or "(0.71, 0.71, 0)".
std::string name_of(const Eigen::Vector3d& direction) {
  constexpr std::array kNames = {"x", "y", "z"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto axis = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i));
    if (are_parallel(direction, axis)) return kNames[i];
  }
  std::ostringstream text;
  const char* separator = "(";
  for (const double component : direction) {
    const double rounded = std::round(100.0 * component) / 100.0;
    text << separator << (rounded == 0.0 ? 0.0 : rounded);  // never -0
    separator = ", ";
  }
  text << ')';
  return text.str();
}

std::string turn_text(const Axis& axis) {
  const std::string angle = std::to_string(std::lround(kDegrees * axis.least)) + " degrees";
  std::string text = axis.turns == 1 ? angle : "multiples of " + angle;
  if (axis.turns >= kAllTurns) text = "any angle";
  return text + " about " + name_of(axis.direction);
}

bool contains(const std::vector<Eigen::Isometry3d>& motions, const Eigen::Isometry3d& motion) {
  return std::any_of(motions.begin(), motions.end(), [&](const Eigen::Isometry3d& known) {
    return log_so3(known.linear().transpose() * motion.linear()).norm() < kSameTurn;
  });
}

/// Returns them with what follows from two of them, one after the other. Turns that a small thing
/// passes only because its field is coarse lead on and on: then as they were found.
std::vector<Eigen::Isometry3d> closed(const std::vector<Eigen::Isometry3d>& found) {
  constexpr std::size_t kMost = 60;  // of what is not round, an icosahedron's
  std::vector<Eigen::Isometry3d> motions = found;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (motions.size() > kMost) return found;
    for (std::size_t j = 0; j <= i; ++j) {
      for (const Eigen::Isometry3d& motion : {motions[i] * motions[j], motions[j] * motions[i]}) {
        if (!contains(motions, motion)) motions.push_back(motion);
      }
    }
  }
  return motions;
}

/// What turns a round model upside down, once: further such motions follow by turns about the axis.
std::vector<Eigen::Isometry3d> flips(const std::vector<Eigen::Isometry3d>& motions,
                                     const Eigen::Vector3d& axis) {
  std::vector<Eigen::Isometry3d> kept{Eigen::Isometry3d::Identity()};
  const auto flip =
      std::find_if(motions.begin(), motions.end(), [&](const Eigen::Isometry3d& motion) {
        return axis.dot(motion.linear() * axis) < -std::cos(kSameTurn);
      });
  if (flip != motions.end()) kept.push_back(*flip);
  return kept;
}

/// Returns a point on the axes of all motions.
Eigen::Vector3d fixed_point(const std::vector<Eigen::Isometry3d>& motions) {
  const auto rows = static_cast<Eigen::Index>(3 * motions.size());
  Eigen::MatrixXd moves(rows, 3);
  Eigen::VectorXd shifts(rows);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    moves.middleRows<3>(row) = Eigen::Matrix3d::Identity() - motions[i].linear();
    shifts.segment<3>(row) = motions[i].translation();
  }
  return moves.completeOrthogonalDecomposition().solve(shifts);
}

/// The part of a rotation that turns about the axis.
Eigen::Matrix3d twist(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& axis) {
  const Eigen::Quaterniond q(rotation);
  const double angle = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  return Eigen::AngleAxisd(angle, axis).matrix();
}

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Tolerances unit;
  return (a.translation() - b.translation()).norm() / unit.translation +
         log_so3(a.linear().transpose() * b.linear()).norm() / unit.rotation;
}

}  // namespace

EqualPoses::EqualPoses(const ArticulatedModel& model) {
  const std::vector<Eigen::Isometry3d> motions = find_symmetries(model);
  centre_ = fixed_point(motions);
  for (const Axis& axis : axes_of(motions)) {
    turns_.push_back(turn_text(axis));
    if (axis.turns >= kAllTurns) round_axes_.push_back(axis.direction);
  }
  if (round_axes_.empty()) {
    motions_ = closed(motions);
  } else if (round_axes_.size() == 1) {
    motions_ = flips(motions, round_axes_.front());
  } else {
    turns_ = {"any angle about any axis"};
  }
}

Eigen::Isometry3d EqualPoses::nearest(const Eigen::Isometry3d& pose,
                                      const Eigen::Isometry3d& other) const {
  Eigen::Isometry3d best = pose;
  for (const Eigen::Isometry3d& motion : motions_) {
    Eigen::Isometry3d equal = pose * motion;
    if (!round_axes_.empty()) {
      Eigen::Matrix3d turn = equal.linear().transpose() * other.linear();
      if (round_axes_.size() == 1) turn = twist(turn, round_axes_.front());
      equal = equal * Eigen::Translation3d(centre_) * Eigen::Quaterniond(turn) *
              Eigen::Translation3d(-centre_);
    }
    if (distance(equal, other) < distance(best, other)) best = equal;
  }
  return best;
}

}  // namespace lockbox
