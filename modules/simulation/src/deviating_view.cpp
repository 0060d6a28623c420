// SPDX-License-Identifier: BSD-3-Clause
#include "deviating_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/core/error.hpp"
#include "rigid_fit.hpp"
#include "rows_at_once.hpp"

namespace lockbox::simulation {
namespace {

double distortion_factor(double squared_radius, const Eigen::Vector2d& k) {
  return 1.0 + squared_radius * (k.x() + squared_radius * k.y());
}

/// Returns the smaller one of two one-sided differences, or none where there is an edge on both
/// sides: the surface goes on as it does away from it.
float change_along(float before, float here, float after) {
  constexpr float kSteepest = 0.02F;  // of the inverse depth, from sample to sample
  const float backward = here - before;
  const float forward = after - here;
  const float change = std::abs(forward) < std::abs(backward) ? forward : backward;
  return std::abs(change) < kSteepest * here ? change : 0.0F;
}

}  // namespace

DeviatingView::DeviatingView(const PinholeCamera& calibration, const PinholeCamera& samples,
                             const SensorDeviation& deviation, const Executor& executor)
    : samples_(samples), camera_(samples), depth_(deviation.depth), executor_(executor) {
  const CameraDeviation& camera = deviation.camera;
  const double refinement = samples.fx / calibration.fx;
  camera_.fx *= camera.focal_length;
  camera_.fy *= camera.focal_length;
  camera_.cx += refinement * camera.principal_point.x();
  camera_.cy += refinement * camera.principal_point.y();
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(index(0, samples.height));
  Eigen::AlignedBox2d box;
  for (int v = 0; v < samples.height; ++v) {
    for (int u = 0; u < samples.width; ++u) {
      Eigen::Vector2d pixel(u, v);
      if (!camera.distortion.isZero(0.0)) {
        const Eigen::Vector3d ray = camera_.back_project(u, v, 1.0);
        pixel = camera_.project(undistorted(ray.head<2>(), camera.distortion).homogeneous());
      }
      box.extend(pixels.emplace_back(pixel));
    }
  }
  // A rim of one pixel, for differences.
  const int left = static_cast<int>(std::floor(box.min().x())) - 1;
  const int top = static_cast<int>(std::floor(box.min().y())) - 1;
  camera_.width = static_cast<int>(std::ceil(box.max().x())) - left + 2;
  camera_.height = static_cast<int>(std::ceil(box.max().y())) - top + 2;
  camera_.cx -= left;
  camera_.cy -= top;
  for (const Eigen::Vector2d& pixel : pixels) {
    const double u = pixel.x() - left;
    const double v = pixel.y() - top;
    sources_.push_back({static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)),
                        u - std::round(u), v - std::round(v)});
  }
}

std::size_t DeviatingView::index(int u, int v) const {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(samples_.width) +
         static_cast<std::size_t>(u);
}

Eigen::Vector2d DeviatingView::undistorted(const Eigen::Vector2d& distorted,
                                           const Eigen::Vector2d& k) const {
  constexpr int kIterations = 50;
  constexpr double kExact = 1e-6;    // a thousandth of a pixel
  constexpr double kFarthest = 2.0;  // times as far out: images stay of a size with the camera's
  Eigen::Vector2d ray = distorted;
  for (int i = 0; i < kIterations; ++i) {
    ray = distorted / std::max(0.1, distortion_factor(ray.squaredNorm(), k));
  }
  const double squared = ray.squaredNorm();
  const Eigen::Vector2d again = ray * distortion_factor(squared, k);
  const double growth = 1.0 + squared * (3.0 * k.x() + squared * 5.0 * k.y());
  if (!((again - distorted).norm() < kExact) || growth <= 0.0 ||
      ray.norm() > kFarthest * distorted.norm() + kExact) {
    throw InputError("distortion", "is so strong that the image folds; choose smaller k1, k2");
  }
  return ray;
}

double DeviatingView::depth(const RenderedDepth& scene, const Source& source) const {
  const auto inverse = [&](int du, int dv) {
    return 1.0F / scene.depth[scene.index(source.u + du, source.v + dv)];
  };
  const float here = inverse(0, 0);
  if (here <= 0.0F) return std::numeric_limits<double>::infinity();
  return 1.0 / (here + source.du * change_along(inverse(-1, 0), here, inverse(1, 0)) +
                source.dv * change_along(inverse(0, -1), here, inverse(0, 1)));
}

double DeviatingView::measured_depth(int u, int v, double z) const {
  const Eigen::Vector2d centre(samples_.cx, samples_.cy);
  const double farthest = std::hypot(std::max(samples_.cx, samples_.width - 1 - samples_.cx),
                                     std::max(samples_.cy, samples_.height - 1 - samples_.cy));
  const double squared = (Eigen::Vector2d(u, v) - centre).squaredNorm() / (farthest * farthest);
  const double measured = z * (depth_.scale + depth_.bend * z + depth_.corners * squared);
  return measured > 0.0 ? measured : std::numeric_limits<double>::infinity();
}

void DeviatingView::measure(const RenderedDepth& scene, RenderedDepth& measured) const {
  measured.width = samples_.width;
  measured.height = samples_.height;
  measured.drawn = {0, 0, samples_.width, samples_.height};
  measured.depth.resize(sources_.size());
  measured.id.resize(sources_.size());
  executor_.for_each_chunk(static_cast<std::size_t>(samples_.height), kRowsAtOnce,
                           [&](std::size_t begin, std::size_t end, std::size_t) {
                             for (int v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
                               for (int u = 0; u < samples_.width; ++u) {
                                 const std::size_t i = index(u, v);
                                 const double z = depth(scene, sources_[i]);
                                 measured.depth[i] = static_cast<float>(measured_depth(u, v, z));
                                 measured.id[i] =
                                     scene.id[scene.index(sources_[i].u, sources_[i].v)];
                               }
                             }
                           });
}

Eigen::Isometry3d DeviatingView::apparent_motion(const RenderedDepth& scene,
                                                 const RenderedDepth& measured, int ids) const {
  constexpr int kStride = 4;  // samples
  RigidFit fit;
  for (int v = 0; v < samples_.height; v += kStride) {
    for (int u = 0; u < samples_.width; u += kStride) {
      const std::size_t i = index(u, v);
      if (measured.id[i] < 0 || measured.id[i] >= ids) continue;
      const Source& source = sources_[i];
      fit.add(
          camera_.back_project(source.u + source.du, source.v + source.dv, depth(scene, source)),
          samples_.back_project(u, v, measured.depth[i]), 1.0);
    }
  }
  return fit.motion();
}

}  // namespace lockbox::simulation
