// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "lockbox/terms/free_space_term.hpp"
#include "lockbox/view/contour.hpp"
#include "observed_surface.hpp"

namespace lockbox {

/// Selects and aims the correspondences of samples away from contours.
class CorrespondenceFinder {
 public:
  /// What is referred to must outlive it.
  CorrespondenceFinder(const FreeSpaceTerm::Scene& scene, const BodyPoses& T_body_camera,
                       double annealing_sigma);

  /// Nothing for a sample that the camera does not see through, or of which it is not known where
  /// it should be. weight: how many samples this one stands for.
  std::optional<FreeSpaceCorrespondence> find(const ViewSample& sample, double weight,
                                              const Eigen::Isometry3d& T_camera_body) const;

 private:
  bool is_beside_contour(const ViewSample& sample, const TangentPlane& plane) const;
  std::optional<FreeSpaceCorrespondence> aim(const ViewSample& sample, double weight,
                                             const Eigen::Vector3d& p, const Pixel& pixel) const;
  double farthest(const Eigen::Vector3d& p) const;
  double variance_of(const Eigen::Vector3d& p, const Eigen::Vector3d& direction) const;

  const VisibleSurface& surface_;
  const ContinuedEdges& continued_;
  const PinholeCamera& camera_;
  const ObservedSurface observed_;
  const TermOptions& options_;
  double outliers_;
  double annealing_sigma_;
};

}  // namespace lockbox
