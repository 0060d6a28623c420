// SPDX-License-Identifier: BSD-3-Clause
// All points of a depth image, by square tiles of it.
#pragma once

#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"

namespace lockbox {

/// Buffers are reused: assign() allocates only when the image size changes.
class ImagePoints : public PointTiles {
 public:
  /// Back-projects the pixels that the cloud, which must have an image, keeps.
  void assign(const TiledCloud& cloud, const Executor& executor);

 private:
  void lay_out(const PinholeCamera& camera);
  void fill_tile(const TiledCloud& cloud, int column, int row);
  void drop_masked(const TiledCloud& cloud, Tile& tile);

  PinholeCamera camera_;
  std::vector<float> ray_x_;  ///< by column, metres per metre of depth
  std::vector<float> ray_y_;  ///< by row
  int tile_columns_ = 0;
  int tile_rows_ = 0;
};

}  // namespace lockbox
