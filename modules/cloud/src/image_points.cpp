// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/image_points.hpp"

#include <algorithm>

#include "lockbox/kernels/back_projection.hpp"
#include "pixel_rays.hpp"

namespace lockbox {

void ImagePoints::assign(const TiledCloud& cloud, const Executor& executor) {
  if (!(cloud.camera() == camera_)) lay_out(cloud.camera());
  executor.for_each(static_cast<std::size_t>(tile_rows_), [&](std::size_t row) {
    for (int column = 0; column < tile_columns_; ++column) {
      fill_tile(cloud, column, static_cast<int>(row));
    }
  });
}

void ImagePoints::lay_out(const PinholeCamera& camera) {
  camera_ = camera;
  tile_columns_ = (camera.width + kTileSize - 1) / kTileSize;
  tile_rows_ = (camera.height + kTileSize - 1) / kTileSize;
  const PixelRays rays(camera);
  ray_x_.resize(static_cast<std::size_t>(tile_columns_ * kTileSize));
  for (std::size_t u = 0; u < ray_x_.size(); ++u) ray_x_[u] = rays.x(static_cast<int>(u));
  ray_y_.resize(static_cast<std::size_t>(tile_rows_ * kTileSize));
  for (std::size_t v = 0; v < ray_y_.size(); ++v) ray_y_[v] = rays.y(static_cast<int>(v));
  resize_tiles(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows_));
}

void ImagePoints::fill_tile(const TiledCloud& cloud, int column, int row) {
  const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) +
                     static_cast<std::size_t>(column);
  Tile& tile = tiles_[index];
  tile.first = index * kTilePoints;
  const int u = column * kTileSize;
  const int v = row * kTileSize;
  const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
                     static_cast<std::size_t>(u);
  const kernels::DepthTile depths{
      cloud.depth().data() + pixel,
      ray_x_.data() + u,
      ray_y_.data() + v,
      static_cast<std::uint32_t>(pixel),
      static_cast<std::uint32_t>(camera_.width),
      static_cast<std::size_t>(std::min(kTileSize, camera_.width - u)),
      static_cast<std::size_t>(std::min(kTileSize, camera_.height - v))};
  kernels::PointBounds bounds;
  tile.count = kernels::back_project(depths,
                                     {x_.data() + tile.first, y_.data() + tile.first,
                                      z_.data() + tile.first, pixel_.data() + tile.first},
                                     bounds);
  if (cloud.is_masked()) {
    drop_masked(cloud, tile);
    return;
  }
  tile.bounds = Eigen::AlignedBox3f(Eigen::Vector3f(bounds.min), Eigen::Vector3f(bounds.max));
  pad(tile);
}

void ImagePoints::drop_masked(const TiledCloud& cloud, Tile& tile) {
  std::size_t slot = tile.first;
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
    if (!cloud.keeps(pixel_[i])) continue;
    x_[slot] = x_[i];
    y_[slot] = y_[i];
    z_[slot] = z_[i];
    pixel_[slot] = pixel_[i];
    ++slot;
  }
  tile.count = slot - tile.first;
  finish_tile(tile);
}

}  // namespace lockbox
