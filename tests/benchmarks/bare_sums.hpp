// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// Of points in a field, all of weight 1 within the field and 0 beyond: one tri-linear look-up with
/// its gradient, and the 27 sums.
NormalSums bare_sums(const FieldView& field, const RigidMotion& body_from_camera,
                     const PointSpan& points);

}  // namespace lockbox::kernels
