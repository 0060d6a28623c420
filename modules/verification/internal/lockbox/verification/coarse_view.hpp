// SPDX-License-Identifier: BSD-3-Clause
// A depth image in few pixels: what hypotheses are scored by, thousands of them.
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

struct CoarseView {
  /// Blocks of pixels, about `columns` a row; each has the median of its measured depths, or 0
  /// where fewer than half of them were measured. shift: the share of a block by which the first
  /// begins after the image's corner, in [0, 1), in whole pixels.
  CoarseView(const TiledCloud& cloud, int columns, const Executor& executor, double shift = 0.0);

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
           static_cast<std::size_t>(u);
  }
  bool contains(int u, int v) const {
    return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
  }
  Eigen::Vector3f point(int u, int v) const {
    return camera.back_project(u, v, static_cast<double>(depth[index(u, v)])).cast<float>();
  }

  PinholeCamera camera;
  std::vector<float> depth;    ///< metres, row by row; 0 where nothing is known
  std::vector<float> nearest;  ///< the least of a pixel's and its eight neighbours' known depths
};

}  // namespace lockbox
