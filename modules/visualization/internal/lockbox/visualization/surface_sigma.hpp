// SPDX-License-Identifier: BSD-3-Clause
// How well it is known where points of the model's surface are.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox {

/// What surface_sigma() gives where a joint on the way to the body is not determined.
inline constexpr float kUndetermined = std::numeric_limits<float>::infinity();

/// Covariances of the bodies' twists in their own frames.
class SurfaceSigma {
 public:
  /// Finds them from the covariance of the estimate; without it from the deviations of the joints
  /// alone, as if the base was known.
  SurfaceSigma(const KinematicTree& tree, const std::vector<Eigen::Isometry3d>& T_camera_body,
               const ShownEstimate& estimate);

  /// Standard deviation of where a point of the body (in its frame, metres) is, metres, over all
  /// directions; kUndetermined where the view does not tell.
  float at(std::size_t body, const Eigen::Vector3d& p_body) const;

 private:
  std::vector<Eigen::Matrix<double, 6, 6>> covariance_;  ///< by body
  std::vector<bool> is_determined_;                      ///< by body
};

}  // namespace lockbox
