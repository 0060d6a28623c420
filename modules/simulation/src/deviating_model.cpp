// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/deviating_model.hpp"

#include <algorithm>
#include <cmath>

#include "added_parts.hpp"
#include "bent_base.hpp"
#include "lockbox/simulation/random_draws.hpp"
#include "missing_parts.hpp"
#include "rigid_fit.hpp"

namespace lockbox {
namespace {

/// What the seed is used for: draws for one purpose do not change with the amount of another.
enum class Purpose : std::uint64_t { sizes = 1, joints, handles, added_parts, bend };

RandomDraws draws(std::uint64_t seed, Purpose purpose) {
  return {seed, static_cast<std::uint64_t>(purpose)};
}

void scale(KinematicTree& tree, double factor) {
  for (Body& body : tree.bodies) {
    for (Eigen::Vector3d& vertex : body.mesh.vertices) vertex *= factor;
  }
  for (Joint& joint : tree.joints) joint.T_parent_joint.translation() *= factor;
}

/// Stretches each body along the axes of its frame, about the middle of its bounds.
void change_sizes(KinematicTree& tree, double most, RandomDraws random) {
  constexpr double kLeast = 0.5;  // of an edge length: thin parts stay parts
  for (Body& body : tree.bodies) {
    const Eigen::AlignedBox3d box = bounds(body.mesh);
    for (int axis = 0; axis < 3; ++axis) {
      const double change = random.uniform(-most, most);
      if (body.mesh.vertices.empty() || box.sizes()[axis] <= 0.0) continue;
      const double factor = std::max(kLeast, 1.0 + change / box.sizes()[axis]);
      for (Eigen::Vector3d& vertex : body.mesh.vertices) {
        vertex[axis] = box.center()[axis] + factor * (vertex[axis] - box.center()[axis]);
      }
    }
  }
}

/// A part goes along with its joint. Neither a turn about the axis nor a shift along that of a
/// sliding joint is drawn: they would be another zero of the joint, not another joint.
void move_joints(KinematicTree& tree, double distance, double angle, RandomDraws random) {
  for (Joint& joint : tree.joints) {
    const Eigen::Vector3d across = joint.axis.cross(random.direction()).normalized();
    Eigen::Vector3d shift = random.direction();
    if (joint.type == JointType::prismatic) {
      shift = joint.axis.cross(shift).normalized();
    }
    joint.T_parent_joint.translate(distance * shift);
    joint.T_parent_joint.rotate(Eigen::AngleAxisd(angle, across));
  }
}

/// Returns the best fit over the surface: a quadratic function's integral over a triangle is its
/// mean at the middles of the edges, times the area.
Eigen::Isometry3d best_fit(const TriangleMesh& from, const TriangleMesh& to) {
  simulation::RigidFit fit;
  for (std::size_t t = 0; t < to.triangles.size(); ++t) {
    const auto source = from.corners(t);
    const auto target = to.corners(t);
    const double weight = area_vector(target).norm();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t next = (i + 1) % 3;
      fit.add(0.5 * (source[i] + source[next]), 0.5 * (target[i] + target[next]), weight);
    }
  }
  return fit.motion();
}

void move_base(KinematicTree& tree, const Eigen::Isometry3d& T) {
  tree.bodies[0].mesh = transformed(std::move(tree.bodies[0].mesh), T);
  for (Joint& joint : tree.joints) {
    if (joint.parent_body == 0) joint.T_parent_joint = T * joint.T_parent_joint;
  }
}

}  // namespace

KinematicTree deviating_model(const KinematicTree& tree, const ObjectDeviation& deviation,
                              std::uint64_t seed, const Executor& executor) {
  KinematicTree built = tree;
  for (Body& body : built.bodies) body.visuals.clear();
  if (deviation.bend > 0.0) {
    constexpr double kShortEdge = 0.03;  // metres: between them a bow stays flat to 0.1 mm
    built.bodies[0].mesh = simulation::with_short_edges(tree.bodies[0].mesh, kShortEdge);
  }
  const TriangleMesh drawn_base = built.bodies[0].mesh;
  if (deviation.scale != 1.0) scale(built, deviation.scale);
  if (deviation.sizes > 0.0) change_sizes(built, deviation.sizes, draws(seed, Purpose::sizes));
  if (deviation.bend > 0.0) {
    const double sign = draws(seed, Purpose::bend).chance(0.5) ? 1.0 : -1.0;
    simulation::bend_base(built, sign * deviation.bend);
  }
  if (deviation.scale != 1.0 || deviation.sizes > 0.0 || deviation.bend > 0.0) {
    move_base(built, best_fit(built.bodies[0].mesh, drawn_base));
  }
  move_joints(built, deviation.joint_origins, deviation.joint_axes, draws(seed, Purpose::joints));
  simulation::take_parts(built, deviation.missing_parts);
  RandomDraws handles = draws(seed, Purpose::handles);
  simulation::take_handles(built, deviation.missing_handles, handles);
  RandomDraws added = draws(seed, Purpose::added_parts);
  simulation::add_parts(built, deviation.added_parts, deviation.added_share, added, executor);
  return built;
}

}  // namespace lockbox
