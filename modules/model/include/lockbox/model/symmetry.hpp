// SPDX-License-Identifier: BSD-3-Clause
// Motions after which nobody can tell that the model has moved.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// The motions T_base_base that map the whole model, joints at rest, onto itself within the
/// tolerance (metres), the identity first. Looked for among the rotations by multiples of 15
/// degrees about the axes of the base and about the principal axes of the surface, through its
/// centre.
std::vector<Eigen::Isometry3d> find_symmetries(const ArticulatedModel& model,
                                               double tolerance = 0.0005);

}  // namespace lockbox
