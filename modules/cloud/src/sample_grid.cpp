// SPDX-License-Identifier: BSD-3-Clause
#include "sample_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

constexpr int kColumns = 160;  ///< about so many samples a row

}  // namespace

SampleGrid::SampleGrid(const TiledCloud& cloud) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  const PinholeCamera& camera = cloud.camera();
  stride = std::clamp(camera.width / kColumns, 1, std::min(camera.width, camera.height));
  columns = camera.width / stride;
  rows = camera.height / stride;
  points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>(
      static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows),
      pcl::PointXYZ(kUnknown, kUnknown, kUnknown));
  points->is_dense = false;
  for (int row = 0; row < rows; ++row) {
    const int v = row * stride + stride / 2;
    for (int column = 0; column < columns; ++column) {
      const int u = column * stride + stride / 2;
      const float z =
          cloud.depth()[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
                        static_cast<std::size_t>(u)];
      if (z > 0.0F) {
        (*points)[index(column, row)].getVector3fMap() = camera.back_project(u, v, z).cast<float>();
      }
    }
  }
}

bool SampleGrid::is_measured(std::size_t sample) const {
  return std::isfinite((*points)[sample].z);
}

}  // namespace lockbox
