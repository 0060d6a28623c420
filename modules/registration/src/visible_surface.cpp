// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/visible_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kRowsPerChunk = 16;
constexpr std::size_t kColumnsPerChunk = 64;
constexpr std::size_t kTilesPerChunk = 64;
constexpr std::uint8_t kFarthest = 255;

/// distance <- min(distance, neighbour + 1) for each pixel of a row and its neighbour in another
/// one. Without a branch, so that it is done for many pixels at once.
void relax(const std::uint8_t* neighbours, std::size_t count, std::uint8_t* distances) {
  for (std::size_t u = 0; u < count; ++u) {
    const auto next =
        static_cast<std::uint8_t>(neighbours[u] + (neighbours[u] != kFarthest ? 1 : 0));
    distances[u] = std::min(distances[u], next);
  }
}

/// Along a row from a pixel of the model (or from where there is none) to the next one.
void fill_gap(std::uint8_t* row, std::size_t begin, std::size_t end, std::size_t width) {
  const std::size_t farthest = kFarthest;
  for (std::size_t u = begin; u < end; ++u) {
    const std::size_t before = begin > 0 ? u - begin + 1 : farthest;
    const std::size_t after = end < width ? end - u : farthest;
    row[u] = static_cast<std::uint8_t>(std::min({before, after, farthest}));
  }
}

/// Pixels along a row to the nearest that shows the model.
void measure_row_distance(const std::int16_t* id, std::size_t width, std::uint8_t* row) {
  for (std::size_t u = 0; u < width;) {
    const bool is_model = id[u] != kNothing;
    std::size_t end = u + 1;
    while (end < width && (id[end] != kNothing) == is_model) ++end;
    if (is_model) {
      std::fill(row + u, row + end, std::uint8_t{0});
    } else {
      fill_gap(row, u, end, width);
    }
    u = end;
  }
}

/// Pixel (u, v) has the ray of the camera's pixel (n u + n / 2, n v + n / 2).
PinholeCamera every_nth_pixel(const PinholeCamera& camera, int n) {
  const int first = n / 2;
  return {camera.width / n, camera.height / n,       camera.fx / n,
          camera.fy / n,    (camera.cx - first) / n, (camera.cy - first) / n};
}

}  // namespace

void VisibleSurface::render(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                            const PinholeCamera& camera, int most_columns,
                            const Executor& executor) {
  const int reduction = std::max(1, (camera.width + most_columns / 2) / most_columns);
  if (!(camera == full_camera_)) {
    full_camera_ = camera;
    renderers_.clear();
  }
  reduction_ = reduction;
  renderers_.resize(std::max(renderers_.size(), static_cast<std::size_t>(reduction) + 1));
  std::unique_ptr<DepthRenderer>& own = renderers_[static_cast<std::size_t>(reduction)];
  if (!own) own = std::make_unique<DepthRenderer>(every_nth_pixel(camera, reduction), executor);
  renderer_ = own.get();
  items_.clear();
  for (std::size_t b = 0; b < model.tree.bodies.size(); ++b) {
    if (model.fields[b]) {
      items_.push_back(body_item(model.tree, b, T_camera_body[b]));
    }
  }
  renderer_->render(items_, image_);
  find_view_pixels();
  T_body_camera_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    T_body_camera_[b] = T_camera_body[b].inverse();
  }
  measure_outline_distance(executor);
}

/// What a reduced view cuts off at the right and below is as its last column and row.
void VisibleSurface::find_view_pixels() {
  view_column_.resize(static_cast<std::size_t>(full_camera_.width));
  view_row_.resize(static_cast<std::size_t>(full_camera_.height));
  for (int u = 0; u < full_camera_.width; ++u) {
    view_column_[static_cast<std::size_t>(u)] =
        static_cast<std::uint32_t>(std::min(u / reduction_, image_.width - 1));
  }
  for (int v = 0; v < full_camera_.height; ++v) {
    view_row_[static_cast<std::size_t>(v)] =
        static_cast<std::uint32_t>(std::min(v / reduction_, image_.height - 1) * image_.width);
  }
}

/// City-block distances, which are separable: along rows, then along columns.
void VisibleSurface::measure_outline_distance(const Executor& executor) {
  const ImageWindow& drawn = image_.drawn;
  outline_distance_.resize(image_.id.size());
  const auto width = static_cast<std::size_t>(image_.width);
  const auto row_at = [&](std::size_t row) {
    return outline_distance_.data() + image_.index(drawn.left, drawn.top) + row * width;
  };
  const auto rows = static_cast<std::size_t>(drawn.height);
  const auto columns = static_cast<std::size_t>(drawn.width);
  executor.for_each_chunk(rows, kRowsPerChunk, [&](std::size_t begin, std::size_t end, auto) {
    for (std::size_t row = begin; row < end; ++row) {
      const std::size_t first = image_.index(drawn.left, drawn.top) + row * width;
      measure_row_distance(image_.id.data() + first, columns, row_at(row));
    }
  });
  executor.for_each_chunk(columns, kColumnsPerChunk, [&](std::size_t begin, std::size_t end, auto) {
    for (std::size_t row = 1; row < rows; ++row) {
      relax(row_at(row - 1) + begin, end - begin, row_at(row) + begin);
    }
    for (std::size_t row = rows - 1; row > 0; --row) {
      relax(row_at(row) + begin, end - begin, row_at(row - 1) + begin);
    }
  });
}

/// From where nothing is drawn, the way to the nearest pixel leads through the nearest one that is.
int VisibleSurface::pixels_to_outline(std::size_t pixel) const {
  const ImageWindow& drawn = image_.drawn;
  if (drawn.width == 0) return kFarthest;
  const int u = static_cast<int>(pixel) % image_.width;
  const int v = static_cast<int>(pixel) / image_.width;
  const int nearest_u = std::clamp(u, drawn.left, drawn.right() - 1);
  const int nearest_v = std::clamp(v, drawn.top, drawn.bottom() - 1);
  const int from_there = outline_distance_[image_.index(nearest_u, nearest_v)];
  return std::min<int>(kFarthest, std::abs(u - nearest_u) + std::abs(v - nearest_v) + from_there);
}

void VisibleSurface::predict(const PointTiles& points, const Executor& executor,
                             PixelPrediction& prediction) const {
  prediction.body.resize(points.x().size());
  prediction.depth.resize(points.x().size());
  const auto width = static_cast<std::uint32_t>(full_camera_.width);
  const double row_per_pixel = 1.0 / full_camera_.width;
  const auto view_pixel = [&](std::uint32_t pixel) {
    // From the pixel's middle: exact, and faster than to divide integers.
    const auto v = static_cast<std::uint32_t>((pixel + 0.5) * row_per_pixel);
    return view_row_[v] + view_column_[pixel - v * width];
  };
  const auto pixel_size = static_cast<float>(static_cast<double>(reduction_) / full_camera_.fx);
  const auto predict_one = [&](std::size_t i) {
    const std::size_t at = view_pixel(points.pixel()[i]);
    const bool shows_body = image_.id[at] != kNothing;
    const auto beside = [&] {
      return static_cast<float>(pixels_to_outline(at)) * pixel_size * points.z()[i];
    };
    prediction.body[i] =
        shows_body ? static_cast<float>(image_.id[at]) : kernels::label_beside(beside());
    prediction.depth[i] = shows_body ? image_.depth[at] : 0.0F;
  };
  executor.for_each_chunk(points.tiles().size(), kTilesPerChunk,
                          [&](std::size_t begin, std::size_t end, auto) {
                            for (std::size_t t = begin; t < end; ++t) {
                              const Tile& tile = points.tiles()[t];
                              for (std::size_t i = tile.first; i < tile.first + tile.padded; ++i) {
                                predict_one(i);
                              }
                            }
                          });
}

}  // namespace lockbox
