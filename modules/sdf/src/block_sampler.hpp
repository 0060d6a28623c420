// SPDX-License-Identifier: BSD-3-Clause
// Signed distances at the samples of one fine block.
#pragma once

#include "fine_layout.hpp"
#include "winding_tree.hpp"

namespace lockbox {

/// Works on one block at a time; keep one per thread.
///
/// Distances: the triangles that can be nearest to a box of samples are those within the nearest
/// one's distance from its middle plus its diagonal; the box is divided, and the list with it,
/// until few triangles remain.
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
  using Slots = std::vector<std::uint32_t>;
  struct Range {
    Eigen::Array3i begin;
    Eigen::Array3i end;
  };

  void set_distances(const Range& range, const Slots& candidates);
  Slots nearest_candidates(const Range& range, const Slots& candidates) const;
  double distance(const Eigen::Vector3d& p, const Slots& candidates) const;
  template <typename Distance>
  void for_each_sample(const Range& range, Distance&& distance_at);
  void set_signs(bool is_closed);
  void join_region();
  bool is_inside(std::size_t sample) const;

  const FineLayout& layout_;
  const TriangleTree& tree_;
  const WindingTree& winding_;
  const std::vector<std::uint8_t>& open_;
  Eigen::AlignedBox3d bounds_;
  Eigen::Vector3i first_;
  Distances distances_;
  std::array<std::uint8_t, kBlockVolume> visited_;
  std::vector<std::size_t> region_;
};

}  // namespace lockbox
