// SPDX-License-Identifier: BSD-3-Clause
// A depth image thinned out: one sample for each square cell of pixels, still organized. Where
// things are can be decided on a few thousand samples; which pixels they cover is decided later.
#pragma once

#include "lockbox/cloud/point_cloud.hpp"

namespace lockbox {

/// Sample (column, row) is the pixel in the middle of its cell of stride x stride pixels. Unlike
/// pcl::VoxelGrid, striding keeps the neighbourhoods of the image, at no cost.
struct SampleGrid {
  explicit SampleGrid(const TiledCloud& cloud);

  std::size_t size() const { return points->size(); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  bool is_measured(std::size_t sample) const;

  int stride = 1;  ///< pixels
  int columns = 0;
  int rows = 0;
  pcl::PointCloud<pcl::PointXYZ>::Ptr points;  ///< NaN where nothing is known
};

}  // namespace lockbox
