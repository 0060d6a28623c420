// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/visible_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/view/continued_edges.hpp"

namespace lockbox {
namespace {

/// What a thread takes at once. Source: not recorded. Doubled, threads share the work out less
/// evenly.
constexpr std::size_t kRowsPerChunk = 8;
constexpr std::size_t kColumnsPerChunk = 32;
constexpr std::size_t kTilesPerChunk = 4;
/// Pixels from the contour, and the label of what is as far from it or farther: distances are
/// bytes.
constexpr std::uint8_t kFarthestCounted = 255;
constexpr std::int16_t kFarthestLabel = -1 - kFarthestCounted;
constexpr float kFarBeside = kernels::label_beside(1e6F);  // metres: beyond all gates

/// distance <- min(distance, neighbour + 1) for each pixel of a row and its neighbour in another
/// one. Without a branch, so that it is done for many pixels at once.
void relax(const std::uint8_t* neighbours, std::size_t count, std::uint8_t* distances) {
  for (std::size_t u = 0; u < count; ++u) {
    const auto next =
        static_cast<std::uint8_t>(neighbours[u] + (neighbours[u] != kFarthestCounted ? 1 : 0));
    distances[u] = std::min(distances[u], next);
  }
}

/// Fills a row from a pixel of the model (or from where there is none) to the next one.
void fill_gap(std::uint8_t* row, std::size_t begin, std::size_t end, std::size_t width) {
  const std::size_t farthest = kFarthestCounted;
  for (std::size_t u = begin; u < end; ++u) {
    const std::size_t before = begin > 0 ? u - begin + 1 : farthest;
    const std::size_t after = end < width ? end - u : farthest;
    row[u] = static_cast<std::uint8_t>(std::min({before, after, farthest}));
  }
}

/// Pixels along a row to the nearest that shows the model.
void measure_row_distance(const std::int16_t* id, std::size_t width, std::uint8_t* row) {
  const auto column = [id](const std::int16_t* at) { return static_cast<std::size_t>(at - id); };
  for (std::size_t u = 0; u < width;) {
    const std::size_t begin = column(
        std::find_if(id + u, id + width, [](std::int16_t label) { return label != kNothing; }));
    fill_gap(row, u, begin, width);
    u = column(std::find(id + begin, id + width, kNothing));
    std::fill(row + begin, row + u, std::uint8_t{0});
  }
}

/// Pixel (u, v) has the ray of the camera's pixel (n u + n / 2, n v + n / 2).
PinholeCamera every_nth_pixel(const PinholeCamera& camera, int n) {
  const int first = n / 2;
  return {camera.width / n, camera.height / n,       camera.fx / n,
          camera.fy / n,    (camera.cx - first) / n, (camera.cy - first) / n};
}

/// Metres of depth for one across. No sensor measures what is seen at less than 10 degrees: a
/// steeper step is an edge. Doubled, low steps are taken for faces; halved, faces that
/// are seen at less than 18 degrees are left to their contours.
constexpr float kSteepest = 5.7F;

}  // namespace

void VisibleSurface::render(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                            const PinholeCamera& camera, int most_columns,
                            const Executor& executor) {
  const int reduction = std::max(1, (camera.width + most_columns / 2) / most_columns);
  const bool is_known = renderer_ != nullptr && camera == full_camera_ && reduction == reduction_;
  if (!(camera == full_camera_)) renderers_.clear();
  full_camera_ = camera;
  reduction_ = reduction;
  renderers_.resize(std::max(renderers_.size(), static_cast<std::size_t>(reduction) + 1));
  std::unique_ptr<DepthRenderer>& own = renderers_[static_cast<std::size_t>(reduction)];
  if (!own) own = std::make_unique<DepthRenderer>(every_nth_pixel(camera, reduction), executor);
  renderer_ = own.get();
  if (!is_known) find_view_pixels();
  items_.clear();
  for (std::size_t b = 0; b < model.tree.bodies.size(); ++b) {
    if (model.fields[b]) {
      items_.push_back(body_item(model.tree, b, T_camera_body[b]));
    }
  }
  renderer_->render(items_, image_);
  T_body_camera_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    T_body_camera_[b] = T_camera_body[b].inverse();
  }
  measure_contour_distance(executor);
  label_pixels(executor);
}

/// What a reduced view cuts off at the right and below is as its last column and row.
void VisibleSurface::find_view_pixels() {
  view_pixel_.clear();
  view_pixel_.reserve(static_cast<std::size_t>(full_camera_.width) *
                      static_cast<std::size_t>(full_camera_.height));
  const PinholeCamera& view = view_camera();
  for (int v = 0; v < full_camera_.height; ++v) {
    const int row = std::min(v / reduction_, view.height - 1) * view.width;
    for (int u = 0; u < full_camera_.width; ++u) {
      const int column = std::min(u / reduction_, view.width - 1);
      view_pixel_.push_back(static_cast<std::uint32_t>(row + column));
    }
  }
}

/// City-block distances, which are separable: along rows, then along columns.
void VisibleSurface::measure_contour_distance(const Executor& executor) {
  const ImageWindow& drawn = image_.drawn;
  contour_distance_.resize(image_.id.size());
  const auto width = static_cast<std::size_t>(image_.width);
  const auto row_at = [&](std::size_t row) {
    return contour_distance_.data() + image_.index(drawn.left, drawn.top) + row * width;
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

/// All pixels: numbers of bodies, and outside them how far they are. From where nothing is drawn,
/// the way to the nearest body leads through the nearest pixel that is.
void VisibleSurface::label_pixels(const Executor& executor) {
  const ImageWindow& drawn = image_.drawn;
  label_.resize(image_.id.size());
  if (drawn.width == 0) {
    std::fill(label_.begin(), label_.end(), kFarthestLabel);
    return;
  }
  executor.for_each_chunk(static_cast<std::size_t>(image_.height), kRowsPerChunk,
                          [&](std::size_t begin, std::size_t end, auto) {
                            for (std::size_t v = begin; v < end; ++v) {
                              label_row(static_cast<int>(v));
                            }
                          });
}

void VisibleSurface::label_row(int v) {
  static_assert(kNothing == -1);
  const ImageWindow& drawn = image_.drawn;
  const int nearest_v = std::clamp(v, drawn.top, drawn.bottom() - 1);
  const int rows = std::abs(v - nearest_v);
  const std::int16_t* __restrict id = image_.id.data() + image_.index(0, nearest_v);
  const std::uint8_t* __restrict distance = contour_distance_.data() + image_.index(0, nearest_v);
  std::int16_t* __restrict label = label_.data() + image_.index(0, v);
  const auto beside = [](int pixels) {
    return static_cast<std::int16_t>(std::max<int>(kFarthestLabel, -1 - pixels));
  };
  for (int u = 0; u < drawn.left; ++u) {
    label[u] = beside(rows + drawn.left - u + distance[drawn.left]);
  }
  if (rows == 0) {
    // Of bodies the distance is zero, of nothing the number is -1.
    for (int u = drawn.left; u < drawn.right(); ++u) {
      label[u] = static_cast<std::int16_t>(id[u] - distance[u]);
    }
  } else {
    for (int u = drawn.left; u < drawn.right(); ++u) label[u] = beside(rows + distance[u]);
  }
  for (int u = drawn.right(); u < image_.width; ++u) {
    label[u] = beside(rows + u - drawn.right() + 1 + distance[drawn.right() - 1]);
  }
}

void VisibleSurface::predict(const PointTiles& points, const ContinuedEdges& continued,
                             const Executor& executor, PixelPrediction& prediction) const {
  prediction.body.resize(points.x().size());
  prediction.depth.resize(points.x().size());
  const auto pixel_size = static_cast<float>(static_cast<double>(reduction_) / full_camera_.fx);
  const auto predict_tile = [&](const Tile& tile) {
    const std::uint32_t* __restrict pixel = points.pixel().data() + tile.first;
    const float* __restrict z = points.z().data() + tile.first;
    float* __restrict body = prediction.body.data() + tile.first;
    float* __restrict depth = prediction.depth.data() + tile.first;
    for (std::size_t i = 0; i < tile.padded; ++i) {
      const std::uint32_t at = view_pixel_[pixel[i]];
      const auto label = static_cast<float>(label_[at]);
      const float drawn = image_.depth[at];  // there is one, whatever it is: so without a branch
      const bool shows_body = label >= 0.0F;
      body[i] = shows_body ? label : kernels::label_beside((-1.0F - label) * pixel_size * z[i]);
      depth[i] = shows_body ? drawn : 0.0F;
    }
    if (!continued.any()) return;
    for (std::size_t i = 0; i < tile.padded; ++i) {
      if (!continued.covers(view_pixel_[pixel[i]])) continue;
      body[i] = kFarBeside;
      depth[i] = 0.0F;
    }
  };
  executor.for_each_chunk(points.tiles().size(), kTilesPerChunk,
                          [&](std::size_t begin, std::size_t end, auto) {
                            for (std::size_t t = begin; t < end; ++t) {
                              predict_tile(points.tiles()[t]);
                            }
                          });
}

bool VisibleSurface::goes_on(int u, int v, int size) const {
  if (u + size > image_.width || v + size > image_.height) return false;
  const std::int16_t body = image_.id[image_.index(u, v)];
  float nearest = image_.depth[image_.index(u, v)];
  float farthest = nearest;
  for (int row = v; row < v + size; ++row) {
    const std::size_t first = image_.index(u, row);
    const std::size_t end = first + static_cast<std::size_t>(size);
    for (std::size_t i = first; i < end; ++i) {
      if (image_.id[i] != body) return false;
      nearest = std::min(nearest, image_.depth[i]);
      farthest = std::max(farthest, image_.depth[i]);
    }
  }
  const auto pixel = static_cast<float>(1.0 / view_camera().fx);
  return farthest - nearest <= kSteepest * static_cast<float>(size) * pixel * nearest;
}

}  // namespace lockbox
