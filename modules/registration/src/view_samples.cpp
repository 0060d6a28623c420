// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/view_samples.hpp"

#include <algorithm>

#include "lockbox/registration/rigid_motion.hpp"

namespace lockbox {
namespace {

/// Calls visit(u, v, spacing) for each sample of a density, at a pixel of the view.
template <typename Visit>
void for_each_sample(const SamplingDensity& density, const RenderedDepth& view,
                     const Visit& visit) {
  constexpr int kSize = SamplingDensity::kCellSize;
  std::size_t cell = 0;
  for (int row = 0; row < density.rows; ++row) {
    for (int column = 0; column < density.columns; ++column, ++cell) {
      const int spacing = density.spacing[cell];
      if (spacing == 0) continue;
      const int first = SamplingDensity::first_sample(spacing);
      const int last_v = std::min((row + 1) * kSize, view.height);
      const int last_u = std::min((column + 1) * kSize, view.width);
      for (int v = row * kSize + first; v < last_v; v += spacing) {
        for (int u = column * kSize + first; u < last_u; u += spacing) {
          visit(u, v, spacing);
        }
      }
    }
  }
}

}  // namespace

void ViewSamples::collect(const VisibleSurface& surface, const SamplingDensity& density) {
  const RenderedDepth& view = surface.view();
  scale_ = surface.reduction();
  chosen_.clear();
  next_.assign(surface.T_body_camera().size(), 0);
  for_each_sample(density, view, [&](int u, int v, int spacing) {
    const std::int16_t body = view.id[view.index(u, v)];
    if (body == kNothing) return;
    chosen_.push_back({{u, v}, spacing});
    ++next_[static_cast<std::size_t>(body)];
  });
  lay_out();
  const PinholeCamera& camera = surface.view_camera();
  for (const Place& place : chosen_) {
    const auto [u, v] = place.pixel;
    const std::size_t pixel = view.index(u, v);
    const auto body = static_cast<std::size_t>(view.id[pixel]);
    const std::size_t number = next_[body]++;
    const Eigen::Vector3f p = (surface.T_body_camera()[body] *
                               camera.back_project(u, v, static_cast<double>(view.depth[pixel])))
                                  .cast<float>();
    x_[number] = p.x();
    y_[number] = p.y();
    z_[number] = p.z();
    places_[number] = place;
  }
}

/// Makes room for the samples of each body, as many as next_ says, and lets next_ say where they
/// begin.
void ViewSamples::lay_out() {
  chunks_.clear();
  std::size_t end = 0;
  for (std::size_t body = 0; body < next_.size(); ++body) {
    const std::size_t first = end;
    for (std::size_t begin = 0; begin < next_[body]; begin += kMostInChunk) {
      chunks_.push_back(
          {static_cast<int>(body), first + begin, std::min(kMostInChunk, next_[body] - begin)});
    }
    end += kernels::padded(next_[body]);
    next_[body] = first;
  }
  for (auto* axis : {&x_, &y_, &z_}) axis->assign(end, kernels::kPadding);
  places_.resize(end);
}

ViewSample ViewSamples::sample(int body, std::size_t number) const {
  const auto& [pixel, spacing] = places_[number];
  const double along = static_cast<double>(spacing) * scale_;
  return {{x_[number], y_[number], z_[number]}, body, pixel, along * along};
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
