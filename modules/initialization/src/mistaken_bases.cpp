// SPDX-License-Identifier: BSD-3-Clause
#include "mistaken_bases.hpp"

#include <utility>

#include "box_turns.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// Source: a laptop has 8, a rule of five links 32. Doubled, arms of twenty links take longer.
constexpr std::size_t kMostMistaken = 32;

/// The motions T_base_body that lay the box of a body onto that of the base, if they are alike.
std::vector<Eigen::Isometry3d> laid_onto(const Eigen::AlignedBox3d& base,
                                         const Eigen::AlignedBox3d& body, double tolerance) {
  std::vector<Eigen::Isometry3d> motions;
  if (base.isEmpty() || body.isEmpty()) return motions;
  for (const Eigen::Matrix3d& rotation : cube_rotations()) {
    const Eigen::Vector3d turned = (rotation * body.sizes()).cwiseAbs();
    if (!are_alike(turned, base.sizes(), tolerance)) continue;
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() = rotation;
    motion.translation() = base.center() - rotation * body.center();
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace

std::vector<Hypothesis> with_base_mistaken(const SoughtModel& sought, const Configuration& held,
                                           const Configuration& answer) {
  const KinematicTree& tree = sought.model.tree;
  const Eigen::AlignedBox3d base = bounds(tree.bodies.front().mesh);
  BodyPoses seen;
  forward_kinematics(tree, answer, seen);
  std::vector<Hypothesis> mistaken;
  const auto add = [&](std::size_t body, const Eigen::Isometry3d& T_camera_body) {
    if (mistaken.size() == kMostMistaken) return;
    Hypothesis hypothesis = with_body_held(sought, held, body, T_camera_body);
    if (has_base(sought.extent, mistaken, hypothesis.configuration.T_camera_base)) return;
    mistaken.push_back(std::move(hypothesis));
  };
  for (std::size_t body = 1; body < tree.bodies.size(); ++body) {
    const Eigen::AlignedBox3d box = bounds(tree.bodies[body].mesh);
    for (const Eigen::Isometry3d& onto : laid_onto(base, box, least_apart(sought.extent))) {
      add(0, seen[body] * onto.inverse());
      add(body, seen.front() * onto);
    }
  }
  return mistaken;
}

}  // namespace lockbox
