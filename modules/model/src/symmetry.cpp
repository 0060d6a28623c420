// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lockbox/model/moved_bodies.hpp"
#include "lockbox/model/variable_range.hpp"
#include "model_surface.hpp"

namespace lockbox {
namespace {

constexpr int kTurns = 24;  // steps of a full turn

/// About an axis through the centre, by a number of steps.
Eigen::Isometry3d turned(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, int turn) {
  const double angle = 2.0 * std::numbers::pi * turn / kTurns;
  return Eigen::Translation3d(centre) * Eigen::AngleAxisd(angle, axis) *
         Eigen::Translation3d(-centre);
}

/// Returns the mirroring in a plane through the centre.
Eigen::Affine3d mirrored(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2.0 * normal * normal.transpose();
  return Eigen::Translation3d(centre) * Eigen::Affine3d(mirror) * Eigen::Translation3d(-centre);
}

bool is_one_of(const std::vector<Eigen::Isometry3d>& motions, const Eigen::Isometry3d& motion) {
  return std::any_of(motions.begin(), motions.end(),
                     [&](const Eigen::Isometry3d& other) { return motion.isApprox(other, 1e-3); });
}

/// One after another they are symmetries, too: quarter turns of a cube about two of its sides make
/// a third of a turn about its diagonal. What is round has more of them than can be listed.
void add_products(const ModelSurface& surface, double tolerance, double share,
                  std::vector<Eigen::Isometry3d>& symmetries) {
  constexpr std::size_t kMost = 60;  // of a body that is not round, an icosahedron's
  const std::size_t generators = symmetries.size();
  for (std::size_t i = 1; i < symmetries.size() && generators <= kMost; ++i) {
    for (std::size_t j = 1; j < generators; ++j) {
      const Eigen::Isometry3d product = symmetries[i] * symmetries[j];
      if (is_one_of(symmetries, product) || !surface.is_kept_by(product, tolerance, share))
        continue;
      if (symmetries.size() == kMost) {
        symmetries.resize(generators);
        return;
      }
      symmetries.push_back(product);
    }
  }
}

std::vector<Eigen::Isometry3d> symmetries_of(const ModelSurface& surface, double tolerance,
                                             double share) {
  std::vector<Eigen::Isometry3d> symmetries{Eigen::Isometry3d::Identity()};
  const Eigen::Matrix<double, 3, 6> axes = surface.axes();
  for (const auto& axis : axes.colwise()) {
    const Eigen::Vector3d centre = share < 1.0 ? surface.centre_about(axis) : surface.centre();
    for (int turn = 1; turn < kTurns; ++turn) {
      const Eigen::Isometry3d motion = turned(centre, axis, turn);
      if (is_one_of(symmetries, motion)) continue;
      if (surface.is_kept_by(motion, tolerance, share)) symmetries.push_back(motion);
    }
  }
  add_products(surface, tolerance, share, symmetries);
  return symmetries;
}

/// Joints each at a share of their range, those that stand alike at rest not alike.
Configuration anywhere(const KinematicTree& tree) {
  Configuration configuration = rest_configuration(tree);
  for (int v = 0; v < tree.variables(); ++v) {
    const VariableRange range = variable_range(tree, v);
    const double golden = std::fmod((v + 1) * std::numbers::phi, 1.0);
    configuration.q[v] = range.lower + (0.2 + 0.6 * golden) * range.extent();
  }
  return configuration;
}

}  // namespace

std::vector<Eigen::Isometry3d> find_symmetries(const ArticulatedModel& model, double tolerance) {
  const Configuration rest = rest_configuration(model.tree);
  return symmetries_of(ModelSurface(model, rest), tolerance, 1.0);
}

std::vector<Eigen::Isometry3d> find_lasting_symmetries(const ArticulatedModel& model,
                                                       double tolerance) {
  std::vector<Eigen::Isometry3d> symmetries = find_symmetries(model, tolerance);
  if (symmetries.size() == 1 || model.tree.variables() == 0) return symmetries;
  const ModelSurface moved(model, anywhere(model.tree));
  std::erase_if(symmetries, [&](const Eigen::Isometry3d& motion) {
    return !moved.is_kept_by(motion, tolerance);
  });
  return symmetries;
}

std::vector<Eigen::Isometry3d> find_body_symmetries(const ArticulatedModel& model, std::size_t body,
                                                    double share, double tolerance) {
  if (!model.fields[body]) return {Eigen::Isometry3d::Identity()};
  return symmetries_of(ModelSurface(model, body), tolerance, share);
}

int count_joint_turns(const ArticulatedModel& model, int variable, double tolerance) {
  const KinematicTree& tree = model.tree;
  const auto number =
      static_cast<std::size_t>(tree.variable_joint[static_cast<std::size_t>(variable)]);
  const Joint& joint = tree.joints[number];
  const auto driven = std::count_if(tree.joints.begin(), tree.joints.end(),
                                    [&](const Joint& other) { return other.variable == variable; });
  if (joint.type == JointType::prismatic || driven > 1) return 1;
  const std::vector<std::uint8_t> moves = moved_bodies(tree, variable);
  std::vector<std::size_t> moved;
  for (std::size_t b = 0; b < moves.size(); ++b) {
    if (moves[b] != 0 && model.fields[b]) moved.push_back(b);
  }
  if (moved.empty()) return 1;
  const ModelSurface surface(model, anywhere(tree), moved);
  const Eigen::Isometry3d& T_base_joint = surface.pose(number + 1);
  const Eigen::Vector3d axis = T_base_joint.linear() * joint.axis;
  for (int turns = kTurns; turns > 1; --turns) {
    const Eigen::AngleAxisd part(2.0 * std::numbers::pi / turns, axis);
    const Eigen::Isometry3d motion = Eigen::Translation3d(T_base_joint.translation()) * part *
                                     Eigen::Translation3d(-T_base_joint.translation());
    if (surface.is_kept_by(motion, tolerance)) return turns;
  }
  return 1;
}

std::vector<Eigen::Vector3d> find_round_axes(const ArticulatedModel& model, double tolerance) {
  if (!model.fields.front()) {
    return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  }
  const ModelSurface surface(model, 0);
  const Eigen::Vector3d centre = surface.centre();
  std::vector<Eigen::Vector3d> round;
  const Eigen::Matrix<double, 3, 6> axes = surface.axes();
  for (const auto& axis : axes.colwise()) {
    constexpr double kParallel = 0.999;  // cosine
    const bool known = std::any_of(round.begin(), round.end(), [&](const Eigen::Vector3d& other) {
      return std::abs(axis.dot(other)) > kParallel;
    });
    bool is_round = !known;
    for (int turn = 1; turn < kTurns && is_round; ++turn) {
      is_round = surface.is_kept_by(turned(centre, axis, turn), tolerance);
    }
    if (is_round) round.emplace_back(axis);
  }
  return round;
}

bool is_own_mirror_image(const ArticulatedModel& model, const Configuration& configuration,
                         double tolerance) {
  const ModelSurface surface(model, configuration);
  const Eigen::Vector3d centre = surface.centre();
  const Eigen::Matrix<double, 3, 6> axes = surface.axes();
  for (const auto& axis : axes.colwise()) {
    const Eigen::Affine3d mirror = mirrored(centre, axis);
    for (int turn = 0; turn < kTurns; ++turn) {
      if (surface.is_kept_by(turned(centre, axis, turn) * mirror, tolerance)) return true;
    }
  }
  return false;
}

}  // namespace lockbox
