// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/visible_surface.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

// One sample a pixel for common sensors: outlines are decided by few samples, so none is spared.
constexpr int kSampleColumns = 640;

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

  samples_.clear();
  const PinholeCamera& view = renderer_->camera();
  for (int v = 0; v < image_.height; ++v) {
    for (int u = 0; u < image_.width; ++u) {
      const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(image_.width) +
                         static_cast<std::size_t>(u);
      const int body = image_.id[pixel];
      if (body != kNothing) {
        const Eigen::Vector3d p_camera =
            view.back_project(u, v, static_cast<double>(image_.depth[pixel]));
        const Eigen::Isometry3d& T = T_camera_body[static_cast<std::size_t>(body)];
        samples_.push_back({(T.inverse() * p_camera).cast<float>(), body, u, v});
      }
    }
  }
}

void VisibleSurface::label(const TiledCloud& cloud, std::vector<float>& visible) const {
  visible.resize(cloud.x().size());
  const auto width = static_cast<std::size_t>(cloud.camera().width);
  const auto reduction = static_cast<std::size_t>(reduction_);
  const auto columns = static_cast<std::size_t>(image_.width);
  const auto rows = static_cast<std::size_t>(image_.height);
  for (const Tile& tile : cloud.tiles()) {
    for (std::size_t i = tile.first; i < tile.first + tile.padded; ++i) {
      const std::size_t u = cloud.pixel()[i] % width / reduction;
      const std::size_t v = cloud.pixel()[i] / width / reduction;
      visible[i] = u < columns && v < rows ? static_cast<float>(image_.id[v * columns + u])
                                           : static_cast<float>(kNothing);
    }
  }
}

}  // namespace lockbox
