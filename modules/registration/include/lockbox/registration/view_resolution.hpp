// SPDX-License-Identifier: BSD-3-Clause
// How closely the model is looked at.
#pragma once

#include <cstddef>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/model_term.hpp"

namespace lockbox {

struct ViewResolution {
  int columns;          ///< of the view
  int outline_spacing;  ///< pixels of the camera, from one point of an outline to the next
  bool edges;           ///< whether the last step is one by the likelihood at edges
};

/// Few points need few rays: more would cost more time than the points, and tell no more. But a
/// model that is small in the image has not many rays to spare. point_budget 0: all points.
ViewResolution view_resolution(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                               const PinholeCamera& camera, std::size_t point_budget);

}  // namespace lockbox
