// SPDX-License-Identifier: BSD-3-Clause
#include "twin_bodies.hpp"

#include <utility>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// Parts whose boxes differ by less may be taken for each other. Unit: metres. Source: what sizes
/// of parts are off by (docs/experiments.md, mismatch: 5 mm). Doubled, drawers of unlike chests
/// are.
constexpr double kSameSize = 0.005;
/// Moves. Source: a grid of three by two drawers has 14. Doubled, a wall of drawers takes longer.
constexpr std::size_t kMostMoves = 16;

/// What moves on the base itself, with its box in its own frame.
struct Part {
  std::size_t body;
  int variable;
  JointType type;
  Eigen::AlignedBox3d box;
};

std::vector<Part> parts_on_base(const KinematicTree& tree) {
  std::vector<Part> parts;
  for (const Joint& joint : tree.joints) {
    const auto body = static_cast<std::size_t>(joint.child_body);
    const Eigen::AlignedBox3d box = bounds(tree.bodies[body].mesh);
    if (joint.parent_body != 0 || joint.variable < 0 || box.isEmpty()) continue;
    parts.push_back({body, joint.variable, joint.type, box});
  }
  return parts;
}

bool are_twins(const Part& a, const Part& b) {
  const Eigen::Vector3d difference = a.box.sizes() - b.box.sizes();
  return a.body != b.body && a.type == b.type && difference.cwiseAbs().maxCoeff() < kSameSize;
}

}  // namespace

std::vector<Hypothesis> moved_along_twins(const SoughtModel& sought, const Configuration& held,
                                          const Configuration& answer) {
  const KinematicTree& tree = sought.model.tree;
  std::vector<Eigen::Isometry3d> of_answer;
  forward_kinematics(tree, answer, of_answer);
  const std::vector<Part> parts = parts_on_base(tree);
  const std::vector<Hypothesis> known{{answer, {}}};
  std::vector<Hypothesis> moves;
  std::vector<Eigen::Isometry3d> at_origin;
  for (const Part& part : parts) {
    for (const Part& other : parts) {
      if (moves.size() == kMostMoves || !are_twins(part, other)) continue;
      Hypothesis moved{held, std::vector<std::uint8_t>(tree.bodies.size(), 0)};
      moved.bodies[0] = 1;
      moved.bodies[part.body] = 1;
      moved.configuration.q[part.variable] = answer.q[other.variable];
      moved.configuration.T_camera_base.setIdentity();
      forward_kinematics(tree, moved.configuration, at_origin);
      const Eigen::Translation3d apart(other.box.center() - part.box.center());
      moved.configuration.T_camera_base =
          of_answer[other.body] * apart * at_origin[part.body].inverse();
      const Eigen::Isometry3d& base = moved.configuration.T_camera_base;
      if (!has_base(sought.extent, known, base) && !has_base(sought.extent, moves, base))
        moves.push_back(std::move(moved));
    }
  }
  return moves;
}

}  // namespace lockbox
