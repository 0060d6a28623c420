// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/visible_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lockbox {
namespace {

// One sample a pixel for common sensors: outlines are decided by few samples, so none is spared.
constexpr int kSampleColumns = 640;
constexpr std::size_t kRowsPerChunk = 16;
constexpr std::size_t kPointsPerChunk = 16384;

}  // namespace

void VisibleSurface::render(const ArticulatedModel& model, const BodyPoses& T_camera_body,
                            const PinholeCamera& camera, const Executor& executor) {
  if (!renderer_ || !(camera == full_camera_)) {
    const int factor = std::max(1, (camera.width + kSampleColumns / 2) / kSampleColumns);
    full_camera_ = camera;
    reduction_ = factor;
    renderer_ = std::make_unique<DepthRenderer>(reduced(camera, factor), executor);
  }
  items_.clear();
  for (std::size_t b = 0; b < model.tree.bodies.size(); ++b) {
    if (model.fields[b]) {
      items_.push_back(
          {&model.tree.bodies[b].mesh, T_camera_body[b], static_cast<std::int16_t>(b)});
    }
  }
  renderer_->render(items_, image_);
  T_body_camera_.resize(T_camera_body.size());
  for (std::size_t b = 0; b < T_camera_body.size(); ++b) {
    T_body_camera_[b] = T_camera_body[b].inverse();
  }
  count_samples(executor);
}

void VisibleSurface::count_samples(const Executor& executor) {
  const auto width = static_cast<std::size_t>(image_.width);
  const auto rows = static_cast<std::size_t>(image_.height);
  row_begins_.assign(rows + 1, 0);
  executor.for_each_chunk(rows, kRowsPerChunk, [&](std::size_t begin, std::size_t end, auto) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto row = image_.id.begin() + static_cast<std::ptrdiff_t>(v * width);
      row_begins_[v + 1] =
          width - static_cast<std::size_t>(std::count(row, row + image_.width, kNothing));
    }
  });
  std::partial_sum(row_begins_.begin(), row_begins_.end(), row_begins_.begin());
}

VisibleSample VisibleSurface::sample(int u, int v) const {
  const std::size_t pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(image_.width) +
                            static_cast<std::size_t>(u);
  const int body = image_.id[pixel];
  const Eigen::Vector3d p_camera =
      view_camera().back_project(u, v, static_cast<double>(image_.depth[pixel]));
  return {(T_body_camera_[static_cast<std::size_t>(body)] * p_camera).cast<float>(), body, u, v};
}

void VisibleSurface::label(const TiledCloud& cloud, const Executor& executor,
                           std::vector<float>& visible) const {
  visible.resize(cloud.x().size());
  const auto width = static_cast<std::size_t>(cloud.camera().width);
  const auto reduction = static_cast<std::size_t>(reduction_);
  const auto columns = static_cast<std::size_t>(image_.width);
  const auto rows = static_cast<std::size_t>(image_.height);
  executor.for_each_chunk(
      visible.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end, auto) {
        for (std::size_t i = begin; i < end; ++i) {
          const std::size_t pixel = cloud.pixel()[i];
          if (reduction == 1) {
            visible[i] = static_cast<float>(image_.id[pixel]);
            continue;
          }
          const std::size_t u = pixel % width / reduction;
          const std::size_t v = pixel / width / reduction;
          visible[i] = u < columns && v < rows ? static_cast<float>(image_.id[v * columns + u])
                                               : static_cast<float>(kNothing);
        }
      });
}

}  // namespace lockbox
