// SPDX-License-Identifier: BSD-3-Clause
// Bounds files: how exactly each frame determines each unknown, as CSV.
//
//   timestamp,tx,ty,tz,rx,ry,rz,<one column a joint variable, named after its joint>
//
// Standard deviations: of the base's twist in the base's frame (metres, radians), then of the joint
// variables (metres or radians); `inf` where the frame says nothing.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

struct FrameBound {
  double stamp = 0.0;     ///< seconds
  Eigen::VectorXd sigma;  ///< one an unknown
};

/// Throws InputError if the file cannot be written.
void write_bounds(const std::filesystem::path& file, const KinematicTree& tree,
                  const std::vector<FrameBound>& bounds);

/// Throws InputError with file and line; the header must be that of the tree.
std::vector<FrameBound> read_bounds(const std::filesystem::path& file, const KinematicTree& tree);

}  // namespace lockbox
