// SPDX-License-Identifier: BSD-3-Clause
// How far surfaces move when something turns or slides.
#pragma once

#include <Eigen/Geometry>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

struct ModelExtent {
  Eigen::Vector3d centre;     ///< of the model at rest, base frame
  Eigen::Vector3d sides;      ///< of the box around it, along the base's axes, metres
  double radius;              ///< of the model at rest, metres
  Eigen::VectorXd variables;  ///< metres that the farthest surface moves for a unit of each
};

ModelExtent model_extent(const KinematicTree& tree);

/// Metres from which on two answers are two: 0.15 of the model's radius, at most 20 mm.
double least_apart(const ModelExtent& extent);

/// How far surfaces may be off while joints are scanned, or a scan goes at once, metres, as chosen
/// for large models: of a smaller one it is as much less, but not less than what real objects are
/// off by.
double search_length(const ModelExtent& extent, double metres);

/// Metres that the farthest corner of the box moves; 0 for an empty box.
double farthest_corner(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& from,
                       const Eigen::Isometry3d& to);

}  // namespace lockbox
