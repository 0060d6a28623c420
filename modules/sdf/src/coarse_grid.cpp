// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_grid.hpp"

#include <cmath>

namespace lockbox {
namespace {

CoarseGrid make_layout(const Eigen::AlignedBox3d& bounds, double reach) {
  constexpr double kVoxel = 0.025;
  constexpr double kMostSamples = 5e5;
  CoarseGrid grid;
  const Eigen::Array3d covered = bounds.sizes().array() + 2.0 * reach;
  grid.voxel = kVoxel;
  while ((covered / grid.voxel + 2.0).prod() > kMostSamples) {
    grid.voxel *= 1.05;
  }
  grid.voxel = static_cast<double>(static_cast<float>(grid.voxel));
  const Eigen::Array3d cells = (covered / grid.voxel).ceil();
  grid.size = cells.cast<int>() + 1;
  const Eigen::Vector3d corner = bounds.center() - 0.5 * grid.voxel * cells.matrix();
  grid.origin = corner.cast<float>().cast<double>();
  return grid;
}

}  // namespace

CoarseGrid sample_coarse_grid(const TriangleTree& tree, const WindingTree& winding, double reach,
                              const Executor& executor) {
  const Eigen::AlignedBox3d& bounds = tree.nodes().front().box;
  CoarseGrid grid = make_layout(bounds, reach);
  const auto width = static_cast<std::size_t>(grid.size.x());
  const auto height = static_cast<std::size_t>(grid.size.y());
  const std::size_t rows = height * static_cast<std::size_t>(grid.size.z());
  grid.distances.resize(rows * width);
  executor.for_each_chunk(rows, 16, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t row = begin; row < end; ++row) {
      const std::size_t layer = row / height;
      std::uint32_t nearest = 0;
      for (std::size_t x = 0; x < width; ++x) {
        const Eigen::Vector3d p =
            grid.origin + grid.voxel * Eigen::Vector3d(static_cast<double>(x),
                                                       static_cast<double>(row % height),
                                                       static_cast<double>(layer));
        const double distance = tree.distance_beside(p, nearest);
        const bool is_inside = bounds.contains(p) && winding.is_inside(p);
        grid.distances[row * width + x] = is_inside ? -distance : distance;
      }
    }
  });
  return grid;
}

}  // namespace lockbox
