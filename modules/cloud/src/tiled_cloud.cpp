// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/tiled_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_frame.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/kernels/depth_filter.hpp"

namespace lockbox {
namespace {

kernels::DepthFilter filter_of(const CloudOptions& options) {
  const bool keeps_flying = !(options.flying_pixel_jump > 0.0);
  return {static_cast<float>(options.min_depth), static_cast<float>(options.max_depth),
          keeps_flying ? std::numeric_limits<float>::infinity()
                       : static_cast<float>(options.flying_pixel_jump)};
}

}  // namespace

void TiledCloud::resize(const PinholeCamera& camera) {
  camera_ = camera;
  mask_.clear();
  blocks_.assign({});
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  depth_.resize(width * height);
  measured_.resize((width + 2) * (height + 2));
  std::fill_n(measured_.begin(), width + 2, 0.0F);
  std::fill_n(measured_.rbegin(), width + 2, 0.0F);
}

void TiledCloud::assign(const DepthFrame& frame, const CloudOptions& options,
                        const Executor& executor) {
  check_frame(frame);
  resize(frame.camera);
  const auto read_row = [&](std::size_t first, std::size_t count, float* metres) {
    kernels::scale_depths(&frame.depth[first], count, frame.metres_per_unit, metres);
  };
  convert(read_row, options, executor);
}

void TiledCloud::assign(const PinholeCamera& camera, std::span<const float> depth,
                        const CloudOptions& options, const Executor& executor) {
  check_image(camera, depth.size());
  resize(camera);
  const auto read_row = [depth](std::size_t first, std::size_t count, float* metres) {
    std::transform(&depth[first], &depth[first] + count, metres,
                   [](float value) { return std::isfinite(value) ? value : 0.0F; });
  };
  convert(read_row, options, executor);
}

void TiledCloud::assign_unorganized(std::span<const Eigen::Vector3f> points,
                                    const PinholeCamera& camera) {
  camera_ = camera;
  depth_.clear();
  mask_.clear();
  blocks_.assign(points);
}

template <typename ReadRow>
void TiledCloud::convert(const ReadRow& read_row, const CloudOptions& options,
                         const Executor& executor) {
  const auto height = static_cast<std::size_t>(camera_.height);
  const auto width = static_cast<std::size_t>(camera_.width);
  const auto measured_row = [&](std::size_t v) { return &measured_[(v + 1) * (width + 2) + 1]; };
  executor.for_each_chunk(height, kTileSize, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t v = begin; v < end; ++v) {
      float* const row = measured_row(v);
      row[-1] = row[width] = 0.0F;
      read_row(v * width, width, row);
    }
  });
  const kernels::DepthFilter filter = filter_of(options);
  executor.for_each_chunk(height, kTileSize, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t v = begin; v < end; ++v) {
      float* const here = measured_row(v);
      kernels::filter_depths({here - (width + 2), here, here + (width + 2)}, width, filter,
                             &depth_[v * width]);
    }
  });
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
}

}  // namespace lockbox
