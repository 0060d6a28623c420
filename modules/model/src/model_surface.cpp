// SPDX-License-Identifier: BSD-3-Clause
#include "model_surface.hpp"

#include <Eigen/Eigenvalues>
#include <limits>
#include <numeric>
#include <utility>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

constexpr double kSamples = 3000.0;

std::vector<std::size_t> all_bodies(const KinematicTree& tree) {
  std::vector<std::size_t> bodies(tree.bodies.size());
  std::iota(bodies.begin(), bodies.end(), std::size_t{0});
  return bodies;
}

}  // namespace

ModelSurface::ModelSurface(const ArticulatedModel& model, const Configuration& configuration)
    : ModelSurface(model, configuration, all_bodies(model.tree)) {}

ModelSurface::ModelSurface(const ArticulatedModel& model, Configuration configuration,
                           std::vector<std::size_t> bodies)
    : model_(model), bodies_(std::move(bodies)) {
  configuration.T_camera_base.setIdentity();
  forward_kinematics(model.tree, configuration, poses_);
  sample();
}

ModelSurface::ModelSurface(const ArticulatedModel& model, std::size_t body)
    : model_(model), bodies_{body}, poses_(body + 1, Eigen::Isometry3d::Identity()) {
  sample();
}

Eigen::Matrix<double, 3, 6> ModelSurface::axes() const {
  const Eigen::Matrix3d spread = second_ / area_ - centre() * centre().transpose();
  Eigen::Matrix<double, 3, 6> axes;
  axes << Eigen::Matrix3d::Identity(),
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  return axes;
}

Eigen::Vector3d ModelSurface::centre_about(const Eigen::Vector3d& axis) const {
  constexpr int kRounds = 20;
  Eigen::Vector3d at = centre();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d information = axis * axis.transpose();  // anywhere along it
    Eigen::Vector3d pull = axis * axis.dot(at);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector3d across = axis.cross(normals_[i]);  // of the plane of axis and normal
      const double missed = across.dot(at - points_[i]);
      const double weight = std::pow(resolution_ / std::max(resolution_, std::abs(missed)), 2);
      information += weight * across * across.transpose();
      pull += weight * across * across.dot(points_[i]);
    }
    at = information.ldlt().solve(pull);
  }
  return at;
}

void ModelSurface::sample() {
  double area = 0.0;
  for (const std::size_t b : bodies_) area += surface_area(model_.tree.bodies[b].mesh);
  for (const std::size_t b : bodies_) {
    if (!model_.fields[b]) continue;
    const TriangleMesh& mesh = model_.tree.bodies[b].mesh;
    resolution_ = std::max(resolution_, model_.fields[b]->voxel());
    add_moments(transformed(mesh, poses_[b]));
    for (const auto& sample : sample_surface(mesh, std::sqrt(area / kSamples))) {
      const Eigen::Vector3d p = poses_[b] * sample.position;
      // Surface inside another body is none.
      if (!(distance(p) > -1e-4)) continue;
      points_.push_back(p);
      normals_.push_back(poses_[b].linear() * sample.normal);
    }
  }
}

double ModelSurface::distance(const Eigen::Vector3d& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t b : bodies_) {
    if (!model_.fields[b]) continue;
    const Eigen::Vector3f p_body = (poses_[b].inverse() * p).cast<float>();
    least = std::min(least, static_cast<double>(model_.fields[b]->sample(p_body).distance));
  }
  return least;
}

void ModelSurface::add_moments(const TriangleMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = mesh.corners(t);
    const double share = area_vector(corners).norm() / 3.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d middle = 0.5 * (corners[i] + corners[(i + 1) % 3]);
      area_ += share;
      first_ += share * middle;
      second_ += share * middle * middle.transpose();
    }
  }
}

}  // namespace lockbox
