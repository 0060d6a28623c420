// SPDX-License-Identifier: BSD-3-Clause
// What of a model is seen from anywhere: whether a motion leaves it where it is.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// The surface of the model in the base's frame, or of some of its bodies. The model must outlive
/// it.
class ModelSurface {
 public:
  ModelSurface(const ArticulatedModel& model, const Configuration& configuration);
  /// Makes the surface of some bodies alone, in the base's frame.
  ModelSurface(const ArticulatedModel& model, Configuration configuration,
               std::vector<std::size_t> bodies);
  /// Makes the surface of one body in its own frame.
  ModelSurface(const ArticulatedModel& model, std::size_t body);

  const Eigen::Isometry3d& pose(std::size_t body) const { return poses_[body]; }

  /// Returns the centre of the area.
  Eigen::Vector3d centre() const { return first_ / area_; }

  /// Returns the axes of the base, and the principal ones.
  Eigen::Matrix<double, 3, 6> axes() const;

  /// Where an axis of that direction is that most of the surface turns about: normals of a surface
  /// of revolution meet its axis (Pottmann and Randrup, Rotational and Helical Surface
  /// Approximation for Reverse Engineering, 1998). Lines that miss it, as those of a handle do,
  /// count the less the farther they do.
  Eigen::Vector3d centre_about(const Eigen::Vector3d& axis) const;

  /// Whether the motion, or mirror, leaves that share of the surface where it is. tolerance:
  /// metres.
  template <typename Motion>
  bool is_kept_by(const Motion& motion, double tolerance, double share = 1.0) const {
    // Between its samples a field rounds off: a corner in the middle of a voxel reads half of it.
    const double limit = tolerance + 0.5 * resolution_;
    double moved_away = (1.0 - share) * static_cast<double>(points_.size());
    return std::all_of(points_.begin(), points_.end(), [&](const Eigen::Vector3d& p) {
      return std::abs(distance(motion * p)) < limit || --moved_away >= 0.0;
    });
  }

 private:
  void sample();
  /// Returns the distance to the union of the bodies, negative inside, metres.
  double distance(const Eigen::Vector3d& p) const;
  /// Exact for triangles: the means over the mid-points of their sides.
  void add_moments(const TriangleMesh& mesh);

  const ArticulatedModel& model_;
  std::vector<std::size_t> bodies_;
  double resolution_ = 0.0;  // of the fields, metres
  double area_ = 0.0;
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace lockbox
