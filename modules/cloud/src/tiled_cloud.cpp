// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/tiled_cloud.hpp"

#include <algorithm>
#include <cmath>

#include "check_frame.hpp"
#include "lockbox/core/error.hpp"
#include "pixel_rays.hpp"

namespace lockbox {
namespace {

/// A measured depth between two neighbours that both lie elsewhere. An unmeasured neighbour says
/// nothing.
bool hangs_between(float before, float depth, float after, float jump) {
  return before > 0.0F && after > 0.0F && std::abs(depth - before) > jump &&
         std::abs(depth - after) > jump;
}

}  // namespace

void TiledCloud::resize(const PinholeCamera& camera) {
  camera_ = camera;
  mask_.clear();
  const auto pixels =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  depth_.resize(pixels);
  tile_columns_ = (camera.width + kTileSize - 1) / kTileSize;
  const int tile_rows = (camera.height + kTileSize - 1) / kTileSize;
  resize_tiles(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows));
}

void TiledCloud::assign(const DepthFrame& frame, const CloudOptions& options,
                        const Executor& executor) {
  check_frame(frame);
  resize(frame.camera);
  convert([&frame](int u, int v) { return frame.metres(u, v); }, options, executor);
}

void TiledCloud::assign(const PinholeCamera& camera, std::span<const float> depth,
                        const CloudOptions& options, const Executor& executor) {
  check_image(camera, depth.size());
  resize(camera);
  const auto raw = [&camera, depth](int u, int v) {
    const float metres =
        depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
              static_cast<std::size_t>(u)];
    return std::isfinite(metres) ? metres : 0.0F;
  };
  convert(raw, options, executor);
}

template <typename Depth>
void TiledCloud::convert(const Depth& raw, const CloudOptions& options, const Executor& executor) {
  executor.for_each_chunk(static_cast<std::size_t>(camera_.height), kTileSize,
                          [&](std::size_t begin, std::size_t end, std::size_t row) {
                            filter_rows(raw, options, static_cast<int>(begin),
                                        static_cast<int>(end));
                            for (int column = 0; column < tile_columns_; ++column) {
                              fill_tile(column, static_cast<int>(row));
                            }
                          });
}

template <typename Depth>
void TiledCloud::filter_rows(const Depth& raw, const CloudOptions& options, int first_row,
                             int last_row) {
  const int width = camera_.width;
  const auto min_depth = static_cast<float>(options.min_depth);
  const auto max_depth = static_cast<float>(options.max_depth);
  const auto jump_factor = static_cast<float>(options.flying_pixel_jump);
  for (int v = first_row; v < last_row; ++v) {
    float* row = depth_.data() + static_cast<std::ptrdiff_t>(v) * width;
    for (int u = 0; u < width; ++u) {
      float depth = raw(u, v);
      if (!(depth >= min_depth && depth <= max_depth)) {
        depth = 0.0F;
      } else if (jump_factor > 0.0F) {
        const float jump = jump_factor * depth * depth;
        const bool flies =
            (u > 0 && u + 1 < width && hangs_between(raw(u - 1, v), depth, raw(u + 1, v), jump)) ||
            (v > 0 && v + 1 < camera_.height &&
             hangs_between(raw(u, v - 1), depth, raw(u, v + 1), jump));
        depth = flies ? 0.0F : depth;
      }
      row[u] = depth;
    }
  }
}

void TiledCloud::fill_tile(int column, int row) {
  const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) +
                     static_cast<std::size_t>(column);
  Tile& tile = tiles_[index];
  tile.first = index * kTilePoints;
  tile.count = 0;
  const PixelRays rays(camera_);
  const int last_u = std::min((column + 1) * kTileSize, camera_.width);
  const int last_v = std::min((row + 1) * kTileSize, camera_.height);
  std::size_t slot = tile.first;
  for (int v = row * kTileSize; v < last_v; ++v) {
    const float ray_y = rays.y(v);
    for (int u = column * kTileSize; u < last_u; ++u) {
      const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
                         static_cast<std::size_t>(u);
      const float z = depth_[pixel];
      if (z > 0.0F) {
        x_[slot] = rays.x(u) * z;
        y_[slot] = ray_y * z;
        z_[slot] = z;
        pixel_[slot] = static_cast<std::uint32_t>(pixel);
        ++slot;
      }
    }
  }
  tile.count = slot - tile.first;
  finish_tile(tile);
}

void TiledCloud::keep(const std::vector<std::uint8_t>& mask) {
  if (mask.size() != depth_.size()) {
    throw InputError("mask of points to keep", "it does not have the size of the image");
  }
  if (mask_.empty()) {
    mask_ = mask;
  } else {
    std::transform(mask.begin(), mask.end(), mask_.begin(), mask_.begin(),
                   [](std::uint8_t now, std::uint8_t before) {
                     return static_cast<std::uint8_t>(now != 0 && before != 0);
                   });
  }
  for (Tile& tile : tiles_) {
    std::size_t slot = tile.first;
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      if (mask[pixel_[i]] != 0) {
        x_[slot] = x_[i];
        y_[slot] = y_[i];
        z_[slot] = z_[i];
        pixel_[slot] = pixel_[i];
        ++slot;
      }
    }
    tile.count = slot - tile.first;
    finish_tile(tile);
  }
}

}  // namespace lockbox
