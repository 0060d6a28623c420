// SPDX-License-Identifier: BSD-3-Clause
// How closely the model is looked at.
#pragma once

#include <cstddef>
#include <limits>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {

inline constexpr std::size_t kAllPatches = std::numeric_limits<std::size_t>::max();

struct ViewDetail {
  std::size_t rays;     ///< at the model, at least, unless its pixels are fewer
  int contour_spacing;  ///< pixels of the camera, from one point of a contour to the next
  /// That the last step compares with the model's edges (EdgeTerm::linearize); 0: there is no such
  /// step.
  std::size_t edge_patches_per_joint;
};

/// Few points need few rays: more would cost more time than the points, and tell no more.
/// point_budget 0: all points.
ViewDetail view_detail(std::size_t point_budget);

/// Returns the columns of a view with so many rays: the nearer the model, the fewer columns are
/// enough.
int view_columns(std::size_t rays, const ArticulatedModel& model, const BodyPoses& T_camera_body,
                 const PinholeCamera& camera);

}  // namespace lockbox
