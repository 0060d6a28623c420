// SPDX-License-Identifier: BSD-3-Clause
// Where the camera saw the model's outlines.
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/registration/outline_points.hpp"
#include "lockbox/registration/registration_options.hpp"

namespace lockbox {

/// An outline passes between two pixels: one that shows the surface that ends there, and one that
/// shows something farther away. In the camera's frame.
struct OutlineSighting {
  Eigen::Vector3d expected;  ///< metres: the model's outline
  Eigen::Vector3d normal;    ///< of it, a unit vector across the ray
  double offset;             ///< metres along the normal to where the camera saw it
  double variance;           ///< of the offset by the sensor's noise, m^2
};

class ObservedOutline {
 public:
  /// All must outlive the object. spread: metres that the model may be off.
  ObservedOutline(const TiledCloud& cloud, const RegistrationOptions& options, double spread)
      : cloud_(cloud), options_(options), spread_(spread) {}

  /// The one nearest to the model's along its normal, sought as far as the noise and the spread
  /// allow. If even there nothing but what lies farther away is seen, it is at least most of that
  /// way inwards.
  std::optional<OutlineSighting> find(const OutlinePoint& point,
                                      const Eigen::Isometry3d& T_camera_body) const;

 private:
  const TiledCloud& cloud_;
  const RegistrationOptions& options_;
  double spread_;
};

}  // namespace lockbox
