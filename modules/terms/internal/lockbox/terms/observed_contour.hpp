// SPDX-License-Identifier: BSD-3-Clause
// Where the camera saw the model's contours.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/view/contour_points.hpp"
#include "lockbox/view/view_options.hpp"

namespace lockbox {

/// Memory of one worker.
class ObservedContour {
 public:
  /// Looks for points of one body; annealing_sigma: metres that the model may be off.
  void look(std::span<const ContourPoint> points, const Eigen::Isometry3d& T_camera_body,
            const TiledCloud& cloud, const ViewOptions& options, double annealing_sigma);

  /// Whether the camera saw that point's contour, metres along its normal to where it did, and the
  /// variance of that by the sensor's noise, m^2.
  bool is_seen(std::size_t point) const { return arrays_[variance][point] > 0.0; }
  double offset_of(std::size_t point) const { return arrays_[offset][point]; }
  double variance_of(std::size_t point) const { return arrays_[variance][point]; }

 private:
  enum Number { px, py, pz, nx, ny, nz, slope, steepness, rise, offset, variance, numbers };
  std::array<std::vector<double>, numbers> arrays_;
};

}  // namespace lockbox
