// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/joint_prominence.hpp"

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
constexpr int kRangeSteps = 4;             // of a joint's range

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

/// By body.
std::vector<std::vector<SurfaceSample>> sample_bodies(const KinematicTree& tree) {
  std::vector<std::vector<SurfaceSample>> samples(tree.bodies.size());
  std::transform(tree.bodies.begin(), tree.bodies.end(), samples.begin(), [](const Body& body) {
    const double spacing = std::sqrt(surface_area(body.mesh) / kSurfaceSamples);
    return spacing > 0.0 ? sample_surface(body.mesh, spacing) : std::vector<SurfaceSample>{};
  });
  return samples;
}

double prominence_at(const ArticulatedModel& model, const std::vector<std::uint8_t>& moved,
                     const std::vector<std::vector<SurfaceSample>>& samples,
                     const Configuration& configuration) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, configuration, poses);
  double farthest = 0.0;
  for (std::size_t b = 0; b < moved.size(); ++b) {
    if (moved[b] == 0) continue;
    for (const SurfaceSample& sample : samples[b]) {
      farthest =
          std::max(farthest, distance_to_resting(model, moved, poses, poses[b] * sample.position));
    }
  }
  return farthest;
}

}  // namespace

Eigen::VectorXd joint_prominences(const ArticulatedModel& model) {
  const KinematicTree& tree = model.tree;
  const auto samples = sample_bodies(tree);
  Eigen::VectorXd prominences = Eigen::VectorXd::Zero(tree.variables());
  Configuration configuration = rest_configuration(tree);
  configuration.T_camera_base.setIdentity();
  const Eigen::VectorXd rest = configuration.q;
  for (int v = 0; v < tree.variables(); ++v) {
    const std::vector<std::uint8_t> moved = moved_bodies(tree, v);
    for (const double position : positions_in(variable_range(tree, v), kRangeSteps)) {
      configuration.q[v] = position;
      prominences[v] =
          std::max(prominences[v], prominence_at(model, moved, samples, configuration));
    }
    configuration.q[v] = rest[v];
  }
  return prominences;
}

}  // namespace lockbox
