// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "lockbox/model/configuration.hpp"

namespace lockbox {

/// The box along the axes of the model's base frame that holds all of the model, joints as in the
/// configuration; metres.
Eigen::AlignedBox3d model_bounds(const KinematicTree& tree, const Configuration& configuration);

}  // namespace lockbox
