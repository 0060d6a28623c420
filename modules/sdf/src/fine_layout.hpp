// SPDX-License-Identifier: BSD-3-Clause
// Where the fine blocks of a field lie, and which of them are near enough to be stored.
#pragma once

#include "lockbox/core/parallel.hpp"
#include "lockbox/kernels/field_view.hpp"
#include "triangle_tree.hpp"

namespace lockbox {

struct FineLayout {
  double voxel = 0.0;                                ///< metres, exactly a float
  double band = 0.0;                                 ///< metres
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of sample (0, 0, 0), exactly floats
  Eigen::Vector3i blocks = Eigen::Vector3i::Zero();

  std::size_t block_count() const;
  /// First sample of a block, counted in samples.
  Eigen::Vector3i first_sample(std::size_t block) const;
  Eigen::Vector3d position(const Eigen::Vector3i& sample) const {
    return origin + voxel * sample.cast<double>();
  }
  /// Middle of the samples first .. first + cells.
  Eigen::Vector3d middle(const Eigen::Vector3i& first, int cells) const {
    return position(first) + Eigen::Vector3d::Constant(0.5 * voxel * cells);
  }
  /// No distance in a stored block exceeds it, metres.
  double largest_distance() const;
};

/// Blocks that cover the bounds and the band around them, centred on the bounds.
FineLayout make_fine_layout(const Eigen::AlignedBox3d& bounds, double voxel, double band);

/// Numbers of the blocks that come within the band of a triangle, ascending. Slightly generous: a
/// block may be farther by less than a voxel.
std::vector<std::size_t> blocks_near_surface(const FineLayout& layout, const TriangleTree& tree,
                                             const Executor& executor);

}  // namespace lockbox
