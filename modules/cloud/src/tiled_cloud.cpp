// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/tiled_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_frame.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/kernels/back_projection.hpp"
#include "pixel_rays.hpp"

namespace lockbox {
namespace {

/// 1 for a measured depth between two neighbours that both lie elsewhere. An unmeasured neighbour
/// says nothing.
int hangs_between(float before, float depth, float after, float jump) {
  return static_cast<int>(before > 0.0F) & static_cast<int>(after > 0.0F) &
         static_cast<int>(std::abs(depth - before) > jump) &
         static_cast<int>(std::abs(depth - after) > jump);
}

/// What is kept of pixels. Without branches, so that it is done for many at once.
struct PixelFilter {
  float min_depth;
  float max_depth;
  float jump_factor;  ///< infinite to keep what flies

  explicit PixelFilter(const CloudOptions& options)
      : min_depth(static_cast<float>(options.min_depth)),
        max_depth(static_cast<float>(options.max_depth)),
        jump_factor(options.flying_pixel_jump > 0.0 ? static_cast<float>(options.flying_pixel_jump)
                                                    : std::numeric_limits<float>::infinity()) {}

  float operator()(float left, float depth, float right, float above, float below) const {
    const float jump = jump_factor * depth * depth;
    const int flies =
        hangs_between(left, depth, right, jump) | hangs_between(above, depth, below, jump);
    const int in_range =
        static_cast<int>(depth >= min_depth) & static_cast<int>(depth <= max_depth);
    return (in_range & ~flies) != 0 ? depth : 0.0F;
  }
};

}  // namespace

void TiledCloud::resize(const PinholeCamera& camera) {
  camera_ = camera;
  mask_.clear();
  const auto pixels =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  raw_.resize(pixels);
  depth_.resize(pixels);
  nowhere_.assign(static_cast<std::size_t>(camera.width), 0.0F);
  tile_columns_ = (camera.width + kTileSize - 1) / kTileSize;
  const int tile_rows = (camera.height + kTileSize - 1) / kTileSize;
  const PixelRays rays(camera);
  ray_x_.resize(static_cast<std::size_t>(tile_columns_ * kTileSize));
  for (std::size_t u = 0; u < ray_x_.size(); ++u) ray_x_[u] = rays.x(static_cast<int>(u));
  ray_y_.resize(static_cast<std::size_t>(tile_rows * kTileSize));
  for (std::size_t v = 0; v < ray_y_.size(); ++v) ray_y_[v] = rays.y(static_cast<int>(v));
  resize_tiles(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows));
}

void TiledCloud::assign(const DepthFrame& frame, const CloudOptions& options,
                        const Executor& executor) {
  check_frame(frame);
  resize(frame.camera);
  const auto metres = [depth = frame.depth.data(), unit = frame.metres_per_unit](std::size_t i) {
    return static_cast<float>(depth[i]) * unit;
  };
  convert(metres, options, executor);
}

void TiledCloud::assign(const PinholeCamera& camera, std::span<const float> depth,
                        const CloudOptions& options, const Executor& executor) {
  check_image(camera, depth.size());
  resize(camera);
  const auto metres = [depth](std::size_t i) { return std::isfinite(depth[i]) ? depth[i] : 0.0F; };
  convert(metres, options, executor);
}

template <typename Depth>
void TiledCloud::convert(const Depth& raw, const CloudOptions& options, const Executor& executor) {
  const auto height = static_cast<std::size_t>(camera_.height);
  const auto width = static_cast<std::size_t>(camera_.width);
  executor.for_each_chunk(height, kTileSize, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t v = begin; v < end; ++v) {
      float* const row = raw_.data() + v * width;
      for (std::size_t u = 0; u < width; ++u) row[u] = raw(v * width + u);
    }
  });
  executor.for_each_chunk(height, kTileSize,
                          [&](std::size_t begin, std::size_t end, std::size_t row) {
                            for (std::size_t v = begin; v < end; ++v) filter_row(options, v);
                            for (int column = 0; column < tile_columns_; ++column) {
                              fill_tile(column, static_cast<int>(row));
                            }
                          });
}

void TiledCloud::filter_row(const CloudOptions& options, std::size_t v) {
  const auto width = static_cast<std::size_t>(camera_.width);
  const PixelFilter filter(options);
  const float* const raw = raw_.data() + v * width;
  // Beyond the image nothing was measured.
  const float* const above = v > 0 ? raw - width : nowhere_.data();
  const float* const below =
      v + 1 < static_cast<std::size_t>(camera_.height) ? raw + width : nowhere_.data();
  float* __restrict row = depth_.data() + v * width;
  for (std::size_t u = 1; u + 1 < width; ++u) {
    row[u] = filter(raw[u - 1], raw[u], raw[u + 1], above[u], below[u]);
  }
  const std::size_t last = width - 1;
  row[0] = filter(0.0F, raw[0], 0.0F, above[0], below[0]);
  row[last] = filter(0.0F, raw[last], 0.0F, above[last], below[last]);
}

void TiledCloud::fill_tile(int column, int row) {
  const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) +
                     static_cast<std::size_t>(column);
  Tile& tile = tiles_[index];
  tile.first = index * kTilePoints;
  const int u = column * kTileSize;
  const int v = row * kTileSize;
  const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width) +
                     static_cast<std::size_t>(u);
  const kernels::DepthPatch patch{
      depth_.data() + pixel,
      ray_x_.data() + u,
      ray_y_.data() + v,
      static_cast<std::uint32_t>(pixel),
      static_cast<std::uint32_t>(camera_.width),
      static_cast<std::size_t>(std::min(kTileSize, camera_.width - u)),
      static_cast<std::size_t>(std::min(kTileSize, camera_.height - v))};
  kernels::PointBounds bounds;
  tile.count = kernels::back_project(patch,
                                     {x_.data() + tile.first, y_.data() + tile.first,
                                      z_.data() + tile.first, pixel_.data() + tile.first},
                                     bounds);
  tile.bounds = Eigen::AlignedBox3f(Eigen::Vector3f(bounds.min), Eigen::Vector3f(bounds.max));
  pad(tile);
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
