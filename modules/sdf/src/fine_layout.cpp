// SPDX-License-Identifier: BSD-3-Clause
#include "fine_layout.hpp"

#include <cmath>
#include <numbers>

namespace lockbox {
namespace {

/// Whether a cube of cells comes within the band: by its middle, or by that of its eighths.
bool is_near(const FineLayout& layout, const TriangleTree& tree, const Eigen::Vector3i& first,
             int cells) {
  const double half_diagonal = 0.5 * std::numbers::sqrt3 * layout.voxel * cells;
  const double reach = layout.band + half_diagonal;
  // The bound is a little larger than asked for, so that "none found" is told from "just there".
  const double distance = tree.distance(layout.middle(first, cells), 1.01 * reach);
  if (distance <= layout.band || distance > reach) {
    return distance <= layout.band;
  }
  if (cells <= 2) {
    return true;
  }
  for (int eighth = 0; eighth < 8; ++eighth) {
    const Eigen::Vector3i side(eighth & 1, (eighth >> 1) & 1, eighth >> 2);
    if (is_near(layout, tree, first + cells / 2 * side, cells / 2)) {
      return true;
    }
  }
  return false;
}

constexpr int kGroup = 4;  // blocks along an edge of a group

Eigen::Vector3i position_in(const Eigen::Vector3i& size, std::size_t number) {
  const auto nx = static_cast<std::size_t>(size.x());
  const auto ny = static_cast<std::size_t>(size.y());
  return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny),
          static_cast<int>(number / nx / ny)};
}

/// Whether anything of a group of blocks can be within the band.
bool may_be_near(const FineLayout& layout, const TriangleTree& tree, const Eigen::Vector3i& first) {
  constexpr int kCells = kGroup * kBlockCells;
  const double reach = layout.band + 0.51 * std::numbers::sqrt3 * layout.voxel * kCells;
  return tree.distance(layout.middle(kBlockCells * first, kCells), 1.01 * reach) <= reach;
}

/// Marks those blocks of the group, which begins with the block `first`, that are near.
void mark_near(const FineLayout& layout, const TriangleTree& tree, const Eigen::Vector3i& first,
               std::vector<std::uint8_t>& near) {
  if (!may_be_near(layout, tree, first)) return;
  const Eigen::Vector3i end = (first.array() + kGroup).min(layout.blocks.array());
  const auto nx = static_cast<std::size_t>(layout.blocks.x());
  const auto ny = static_cast<std::size_t>(layout.blocks.y());
  for (int z = first.z(); z < end.z(); ++z) {
    for (int y = first.y(); y < end.y(); ++y) {
      for (int x = first.x(); x < end.x(); ++x) {
        const std::size_t row = static_cast<std::size_t>(z) * ny + static_cast<std::size_t>(y);
        const bool is_block_near =
            is_near(layout, tree, kBlockCells * Eigen::Vector3i(x, y, z), kBlockCells);
        near[row * nx + static_cast<std::size_t>(x)] = is_block_near ? 1 : 0;
      }
    }
  }
}

}  // namespace

std::size_t FineLayout::block_count() const {
  return static_cast<std::size_t>(blocks.x()) * static_cast<std::size_t>(blocks.y()) *
         static_cast<std::size_t>(blocks.z());
}

Eigen::Vector3i FineLayout::first_sample(std::size_t block) const {
  return kBlockCells * position_in(blocks, block);
}

double FineLayout::largest_distance() const {
  return band + (kBlockCells + 1) * std::numbers::sqrt3 * voxel;
}

FineLayout make_fine_layout(const Eigen::AlignedBox3d& bounds, double voxel, double band) {
  FineLayout layout;
  // The field is read with floats: the positions that it is sampled at have to be those.
  layout.voxel = static_cast<double>(static_cast<float>(voxel));
  layout.band = band;
  const double block = kBlockCells * layout.voxel;
  const Eigen::Vector3d covered = bounds.sizes().array() + 2.0 * band;
  layout.blocks = (covered / block).array().ceil().cast<int>();
  const Eigen::Vector3d corner = bounds.center() - 0.5 * block * layout.blocks.cast<double>();
  layout.origin = corner.cast<float>().cast<double>();
  return layout;
}

std::vector<std::size_t> blocks_near_surface(const FineLayout& layout, const TriangleTree& tree,
                                             const Executor& executor) {
  std::vector<std::uint8_t> near(layout.block_count());
  // Most of the blocks of a large body are far from its surface: those are passed over together.
  const Eigen::Vector3i groups = (layout.blocks.array() + (kGroup - 1)) / kGroup;
  const auto count = static_cast<std::size_t>(groups.x()) * static_cast<std::size_t>(groups.y()) *
                     static_cast<std::size_t>(groups.z());
  executor.for_each_chunk(count, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t group = begin; group < end; ++group) {
      mark_near(layout, tree, kGroup * position_in(groups, group), near);
    }
  });
  std::vector<std::size_t> blocks;
  for (std::size_t block = 0; block < near.size(); ++block) {
    if (near[block] != 0) {
      blocks.push_back(block);
    }
  }
  return blocks;
}

}  // namespace lockbox
