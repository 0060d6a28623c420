// SPDX-License-Identifier: BSD-3-Clause
// How far surfaces move when something turns or slides.
#pragma once

#include <Eigen/Core>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

struct ModelExtent {
  Eigen::Vector3d centre;     ///< of the model at rest, base frame
  Eigen::Vector3d sides;      ///< of the box around it, along the base's axes, metres
  double radius;              ///< of the model at rest, metres
  Eigen::VectorXd variables;  ///< metres that the farthest surface moves for a unit of each
};

ModelExtent model_extent(const KinematicTree& tree);

}  // namespace lockbox
