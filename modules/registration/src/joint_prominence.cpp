// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/joint_prominence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/model/moved_bodies.hpp"
#include "lockbox/model/variable_range.hpp"

namespace lockbox {
namespace {

constexpr double kSurfaceSamples = 200.0;  // of each body's surface
constexpr int kSteps = 4;                  // of a joint's range

/// Of a point to the nearest body that stays, metres.
double distance_to_resting(const ArticulatedModel& model, const std::vector<std::uint8_t>& moved,
                           const std::vector<Eigen::Isometry3d>& poses, const Eigen::Vector3d& p) {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t b = 0; b < moved.size(); ++b) {
    if (moved[b] != 0 || !model.fields[b]) continue;
    const Eigen::Vector3f p_body = (poses[b].inverse() * p).cast<float>();
    least = std::min(least, model.fields[b]->sample(p_body).distance);
  }
  return static_cast<double>(least);
}

double prominence_at(const ArticulatedModel& model, const std::vector<std::uint8_t>& moved,
                     const Configuration& configuration) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, configuration, poses);
  double farthest = 0.0;
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const TriangleMesh& mesh = model.tree.bodies[b].mesh;
    const double spacing = std::sqrt(surface_area(mesh) / kSurfaceSamples);
    if (moved[b] == 0 || !(spacing > 0.0)) continue;
    for (const SurfaceSample& sample : sample_surface(mesh, spacing)) {
      farthest =
          std::max(farthest, distance_to_resting(model, moved, poses, poses[b] * sample.position));
    }
  }
  return farthest;
}

}  // namespace

Eigen::VectorXd joint_prominences(const ArticulatedModel& model) {
  const KinematicTree& tree = model.tree;
  Eigen::VectorXd prominences = Eigen::VectorXd::Zero(tree.variables());
  Configuration configuration = rest_configuration(tree);
  configuration.T_camera_base.setIdentity();
  const Eigen::VectorXd rest = configuration.q;
  for (int v = 0; v < tree.variables(); ++v) {
    const std::vector<std::uint8_t> moved = moved_bodies(tree, v);
    for (const double position : positions_in(variable_range(tree, v), kSteps)) {
      configuration.q[v] = position;
      prominences[v] = std::max(prominences[v], prominence_at(model, moved, configuration));
    }
    configuration.q[v] = rest[v];
  }
  return prominences;
}

}  // namespace lockbox
