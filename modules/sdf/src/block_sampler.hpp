// SPDX-License-Identifier: BSD-3-Clause
// Signed distances at the samples of one fine block.
#pragma once

#include "fine_layout.hpp"
#include "winding_tree.hpp"

namespace lockbox {

/// Works on one block at a time; keep one per thread.
///
/// Distances: what can be nearest to any of the samples lies not farther from the block's middle
/// than the nearest triangle there and the diagonal together. Few such triangles are tried in
/// turn, as on the large flat faces of CAD; among many the tree is searched for each sample.
///
/// Signs: two neighbours a voxel apart with |d1| + |d2| > voxel cannot have surface between them.
/// Samples joined in this way share one winding number, where all triangles nearby are closed.
class BlockSampler {
 public:
  using Distances = std::array<double, kBlockVolume>;

  /// open: for each slot of the tree, whether its triangle is at an open edge. All is referenced.
  BlockSampler(const FineLayout& layout, const TriangleTree& tree, const WindingTree& winding,
               const std::vector<std::uint8_t>& open);

  /// Metres, x fastest.
  const Distances& sample(std::size_t block);

 private:
  void set_distances();
  double distance_to_candidates(const Eigen::Vector3d& p) const;
  void set_signs(bool is_closed);
  void join_region();
  bool is_inside(std::size_t sample) const;

  const FineLayout& layout_;
  const TriangleTree& tree_;
  const WindingTree& winding_;
  const std::vector<std::uint8_t>& open_;
  Eigen::AlignedBox3d bounds_;
  Eigen::Vector3i first_;
  std::vector<std::uint32_t> candidates_;
  Distances distances_;
  std::array<std::uint8_t, kBlockVolume> visited_;
  std::vector<std::size_t> region_;
};

}  // namespace lockbox
