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

/// A body that stays, as it is looked up.
struct RestingBody {
  const SignedDistanceField* field;
  Eigen::Isometry3d T_body_base;
};

/// Returns bodies that rest. Those after the others in the tree come first: they are nearest to
/// what a joint moves.
std::vector<RestingBody> resting_bodies(const ArticulatedModel& model,
                                        const std::vector<std::uint8_t>& moved,
                                        const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<RestingBody> resting;
  for (std::size_t b = moved.size(); b-- > 0;) {
    if (moved[b] != 0 || !model.fields[b]) continue;
    resting.push_back({&*model.fields[b], poses[b].inverse()});
  }
  return resting;
}

/// Returns the distance of a point to the nearest of these bodies, metres; some distance that is no
/// larger than `enough` where that is none.
double distance_to_resting(const std::vector<RestingBody>& resting, const Eigen::Vector3d& p,
                           double enough) {
  float least = std::numeric_limits<float>::infinity();
  for (const RestingBody& body : resting) {
    const Eigen::Vector3f p_body = (body.T_body_base * p).cast<float>();
    least = std::min(least, body.field->sample(p_body).distance);
    if (static_cast<double>(least) <= enough) break;
  }
  return static_cast<double>(least);
}

/// Samples the bodies, one after the other.
std::vector<std::vector<SurfaceSample>> sample_bodies(const KinematicTree& tree) {
  std::vector<std::vector<SurfaceSample>> samples(tree.bodies.size());
  std::transform(tree.bodies.begin(), tree.bodies.end(), samples.begin(), [](const Body& body) {
    const double spacing = std::sqrt(surface_area(body.mesh) / kSurfaceSamples);
    return spacing > 0.0 ? sample_surface(body.mesh, spacing) : std::vector<SurfaceSample>{};
  });
  return samples;
}

/// The larger one of `farthest` and the distance in this configuration. In a chain the last bodies
/// stand out most: from the end of the tree, most samples need a single look-up.
double prominence_at(const ArticulatedModel& model, const std::vector<std::uint8_t>& moved,
                     const std::vector<std::vector<SurfaceSample>>& samples,
                     const Configuration& configuration, double farthest) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, configuration, poses);
  const std::vector<RestingBody> resting = resting_bodies(model, moved, poses);
  for (std::size_t b = moved.size(); b-- > 0;) {
    if (moved[b] == 0) continue;
    for (const SurfaceSample& sample : samples[b]) {
      const Eigen::Vector3d p = poses[b] * sample.position;
      farthest = std::max(farthest, distance_to_resting(resting, p, farthest));
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
      prominences[v] = prominence_at(model, moved, samples, configuration, prominences[v]);
    }
    configuration.q[v] = rest[v];
  }
  return prominences;
}

}  // namespace lockbox
