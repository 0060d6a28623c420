// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/point_tiles.hpp"

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox {

void PointTiles::resize_tiles(std::size_t count) {
  tiles_.resize(count);
  const std::size_t slots = tiles_.size() * kTilePoints;
  x_.resize(slots);
  y_.resize(slots);
  z_.resize(slots);
  pixel_.resize(slots);
  averaged_pixels_.resize(slots, 1.0F);
}

void PointTiles::finish_tile(Tile& tile) {
  tile.bounds.setEmpty();
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
    tile.bounds.extend(Eigen::Vector3f(x_[i], y_[i], z_[i]));
  }
  pad(tile);
}

void PointTiles::pad(Tile& tile) {
  tile.padded = kernels::padded(tile.count);
  for (std::size_t i = tile.first + tile.count; i < tile.first + tile.padded; ++i) {
    x_[i] = y_[i] = z_[i] = kernels::kPadding;
    pixel_[i] = 0;
  }
}

std::size_t PointTiles::valid_points() const {
  std::size_t count = 0;
  for (const Tile& tile : tiles_) {
    count += tile.count;
  }
  return count;
}

}  // namespace lockbox
