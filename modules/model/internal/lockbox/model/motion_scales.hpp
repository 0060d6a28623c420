// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// How far surfaces move, at most, for a unit of each unknown (metres per metre or radian): base
/// twist (v, w) in the base's frame, then the joint variables. Of the model at rest, by the boxes
/// of its bodies' meshes.
Eigen::VectorXd motion_scales(const KinematicTree& tree);

}  // namespace lockbox
