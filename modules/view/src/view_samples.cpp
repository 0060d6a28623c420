// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/view_samples.hpp"

#include <algorithm>
#include <utility>

#include "lockbox/sdf/rigid_motion.hpp"

namespace lockbox {

void ViewSamples::choose(const VisibleSurface& surface, const SamplingDensity& density,
                         int least_spacing, const Executor& executor) {
  scale_ = surface.reduction();
  rows_.resize(static_cast<std::size_t>(density.rows));
  executor.for_each(rows_.size(), [&](std::size_t row) {
    rows_[row].next.assign(surface.T_body_camera().size(), 0);
    choose_in(surface.view(), density, least_spacing, static_cast<int>(row), rows_[row]);
  });
  lay_out(surface.T_body_camera().size());
}

void ViewSamples::finish() {
  // From above to below, so that whoever places samples has them in its cache when they are read.
  std::sort(chunks_.begin(), chunks_.end(), [&](const Chunk& a, const Chunk& b) {
    return std::pair(places_[a.first].pixel.v, a.first) <
           std::pair(places_[b.first].pixel.v, b.first);
  });
}

void ViewSamples::choose_in(const RenderedDepth& view, const SamplingDensity& density,
                            int least_spacing, int row_of_cells, Row& row) {
  constexpr int kSize = SamplingDensity::kCellSize;
  row.chosen.clear();
  const std::uint8_t* const spacings =
      density.spacing.data() + static_cast<std::ptrdiff_t>(row_of_cells) * density.columns;
  for (int column = 0; column < density.columns; ++column) {
    if (spacings[column] == 0) continue;
    const int spacing = std::max<int>(spacings[column], least_spacing);
    const int first = SamplingDensity::first_sample(spacing);
    const int end_v = std::min((row_of_cells + 1) * kSize, view.height);
    const int end_u = std::min((column + 1) * kSize, view.width);
    for (int v = row_of_cells * kSize + first; v < end_v; v += spacing) {
      for (int u = column * kSize + first; u < end_u; u += spacing) {
        const std::int16_t body = view.id[view.index(u, v)];
        if (body == kNothing) continue;
        row.chosen.push_back({{u, v}, spacing});
        ++row.next[static_cast<std::size_t>(body)];
      }
    }
  }
}

/// Makes room for the samples of each body, row after row, padded for the kernels.
void ViewSamples::lay_out(std::size_t bodies) {
  chunks_.clear();
  std::size_t end = 0;
  for (std::size_t body = 0; body < bodies; ++body) {
    std::size_t count = 0;
    for (Row& row : rows_) {
      const std::size_t own = row.next[body];
      row.next[body] = end + count;
      count += own;
    }
    for (std::size_t begin = 0; begin < count; begin += kMostInChunk) {
      chunks_.push_back(
          {static_cast<int>(body), end + begin, std::min(kMostInChunk, count - begin)});
    }
    const std::size_t padded = kernels::padded(count);
    for (auto* axis : {&x_, &y_, &z_}) {
      axis->resize(std::max(axis->size(), end + padded));
      std::fill_n(axis->begin() + static_cast<std::ptrdiff_t>(end + count), padded - count,
                  kernels::kPadding);
    }
    end += padded;
  }
  places_.resize(std::max(places_.size(), end));
}

void ViewSamples::place_row(const VisibleSurface& surface, std::size_t row_index) {
  Row& row = rows_[row_index];
  const RenderedDepth& view = surface.view();
  const PinholeCamera& camera = surface.view_camera();
  for (const Place& place : row.chosen) {
    const auto [u, v] = place.pixel;
    const std::size_t pixel = view.index(u, v);
    const auto body = static_cast<std::size_t>(view.id[pixel]);
    const std::size_t number = row.next[body]++;
    const Eigen::Vector3f p = (surface.T_body_camera()[body] *
                               camera.back_project(u, v, static_cast<double>(view.depth[pixel])))
                                  .cast<float>();
    x_[number] = p.x();
    y_[number] = p.y();
    z_[number] = p.z();
    places_[number] = place;
  }
}

void SampleLandings::reserve(const Executor& executor) {
  buffers_.resize(static_cast<std::size_t>(executor.threads()) + 1);
  for (Buffers& buffers : buffers_) {
    for (auto* array : {&buffers.expected, &buffers.x, &buffers.y, &buffers.measured}) {
      array->resize(ViewSamples::kMostInChunk);
    }
    buffers.pixel.resize(ViewSamples::kMostInChunk);
  }
}

kernels::Landings SampleLandings::land(const ViewSamples& samples, const ViewSamples::Chunk& chunk,
                                       const BodyPoses& T_camera_body, const TiledCloud& cloud) {
  Buffers& buffers = buffers_[Executor::worker()];
  const kernels::Landings landings{buffers.expected.data(), buffers.x.data(), buffers.y.data(),
                                   buffers.measured.data(), buffers.pixel.data()};
  const PinholeCamera& camera = cloud.camera();
  const kernels::Intrinsics intrinsics{static_cast<float>(camera.fx),
                                       static_cast<float>(camera.fy),
                                       static_cast<float>(camera.cx),
                                       static_cast<float>(camera.cy),
                                       camera.width,
                                       camera.height};
  kernels::land(samples.points(chunk),
                to_rigid_motion(T_camera_body[static_cast<std::size_t>(chunk.body)]),
                {cloud.depth().data(), intrinsics}, landings);
  return landings;
}

}  // namespace lockbox
