// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/pixel_terms.hpp"

#include <array>
#include <cmath>

#include "lockbox/visualization/model_distance.hpp"

namespace lockbox {
namespace {

/// A step in depth of this share of the distance is an edge. Doubled, low steps are none.
constexpr float kDepthStep = 0.01F;

}  // namespace

PixelTerms::PixelTerms(const ArticulatedModel& model) : model_(model) {
  for (std::size_t body = 0; body < model.tree.bodies.size(); ++body) {
    items_.push_back({&model.tree.bodies[body].mesh, Eigen::Isometry3d::Identity(),
                      static_cast<std::int16_t>(body)});
  }
}

void PixelTerms::find(const DepthFrame& frame, const std::vector<Eigen::Isometry3d>& T_camera_body,
                      std::vector<PixelTerm>& terms) {
  for (std::size_t body = 0; body < items_.size(); ++body) {
    items_[body].T_camera_mesh = T_camera_body[body];
  }
  if (!renderer_) renderer_.emplace(frame.camera, Executor(1));
  renderer_->set_camera(frame.camera);
  renderer_->render(items_, rendered_);
  points_.clear();
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const double z = double{frame.metres(u, v)};
      if (z > 0.0) points_.push_back(frame.camera.back_project(u, v, z).cast<float>());
    }
  }
  model_distances(model_, T_camera_body, points_, kTermReach, distances_);
  terms.clear();
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      if (frame.metres(u, v) <= 0.0F) continue;
      terms.push_back(of_pixel(frame, u, v, std::abs(distances_[terms.size()]) <= kTermReach));
    }
  }
}

PixelTerm PixelTerms::of_pixel(const DepthFrame& frame, int u, int v, bool is_near) const {
  const std::size_t pixel = rendered_.index(u, v);
  if (is_near) return is_edge(u, v) ? PixelTerm::edges : PixelTerm::points;
  if (rendered_.id[pixel] == kNothing) return PixelTerm::none;
  return frame.metres(u, v) < rendered_.depth[pixel] ? PixelTerm::hidden : PixelTerm::free_space;
}

bool PixelTerms::is_edge(int u, int v) const {
  const std::size_t here = rendered_.index(u, v);
  for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    if (u + du < 0 || v + dv < 0 || u + du >= rendered_.width || v + dv >= rendered_.height) {
      continue;
    }
    const std::size_t there = rendered_.index(u + du, v + dv);
    if (rendered_.id[here] != rendered_.id[there]) return true;
    if (rendered_.id[here] == kNothing) continue;
    const float step = std::abs(rendered_.depth[there] - rendered_.depth[here]);
    if (step > kDepthStep * rendered_.depth[here]) return true;
  }
  return false;
}

}  // namespace lockbox
