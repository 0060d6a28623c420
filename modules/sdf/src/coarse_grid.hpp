// SPDX-License-Identifier: BSD-3-Clause
// The dense grid that carries distance far beyond the body.
#pragma once

#include "lockbox/core/parallel.hpp"
#include "winding_tree.hpp"

namespace lockbox {

struct CoarseGrid {
  double voxel = 0.0;                                ///< metres, exactly a float
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of sample (0, 0, 0), exactly floats
  Eigen::Vector3i size = Eigen::Vector3i::Zero();    ///< samples along each axis
  std::vector<double> distances;                     ///< metres, signed, x fastest
};

/// 25 mm between samples, more where that would take over half a million of them. reach: metres
/// beyond the bounds of the surface.
CoarseGrid sample_coarse_grid(const TriangleTree& tree, const WindingTree& winding, double reach,
                              const Executor& executor);

}  // namespace lockbox
