// SPDX-License-Identifier: BSD-3-Clause
#include "point_match.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

/// Of a body's diameter: from one of its points to the next. A handle or a leg is as thick.
/// Doubled, such parts are lost; halved, it takes sixteen times as long.
constexpr double kSpacing = 0.06;
/// Of the largest surface: what is smaller is seldom seen without that, and tells less. Source: the
/// arm of a lamp has a quarter of its foot's. Doubled, a lamp whose foot is hidden is not found.
constexpr double kTelling = 0.2;
/// Bodies that propose. Source: a lamp has three. Doubled, arms of equal links take twice as long.
constexpr std::size_t kMostTelling = 4;
/// Of the diameter that a plane reaches beyond its middle, if it is the model's: half, and as much
/// as grows into what is beside it.
constexpr double kWidePlane = 0.7;
constexpr double kInPlane = 4.0;  // standard deviations of a sample: all of a plane, its ends too

double reach_of(const CoarseView& view, const PlanarRegion& region) {
  const Eigen::Vector3f middle = region_frame(view, region).translation().cast<float>();
  const auto width = static_cast<std::size_t>(view.camera.width);
  float farthest = 0.0F;
  for (const std::size_t sample : region.samples) {
    const Eigen::Vector3f p =
        view.point(static_cast<int>(sample % width), static_cast<int>(sample / width));
    farthest = std::max(farthest, (p - middle).norm());
  }
  return static_cast<double>(farthest);
}

}  // namespace

std::vector<std::size_t> telling_bodies(const KinematicTree& tree) {
  std::vector<double> areas;
  for (const Body& body : tree.bodies) areas.push_back(surface_area(body.mesh));
  const double least = kTelling * *std::max_element(areas.begin(), areas.end());
  std::vector<std::size_t> bodies;
  for (std::size_t b = 0; b < areas.size(); ++b) {
    if (areas[b] > 0.0 && areas[b] >= least) bodies.push_back(b);
  }
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  bodies.resize(std::min(bodies.size(), kMostTelling));
  return bodies;
}

BodyPairs make_body_pairs(const KinematicTree& tree, std::size_t body, const Executor& executor) {
  const double diameter = bounds(tree.bodies[body].mesh).diagonal().norm();
  const double spacing = kSpacing * diameter;
  return {body, PointPairs(points_of_body(tree, body, spacing, executor), diameter, spacing)};
}

std::vector<float> without_wide_planes(const CoarseView& view, const PlanarScene& scene,
                                       double diameter) {
  std::vector<float> depth = view.depth;
  const int factor = std::max(1, view.camera.width / scene.view.camera.width);
  const auto tolerance = static_cast<float>(kInPlane * scene.noise);
  const auto width = static_cast<std::size_t>(scene.view.camera.width);
  for (const PlanarRegion& region : scene.regions) {
    if (reach_of(scene.view, region) < kWidePlane * diameter) continue;
    for (const std::size_t sample : region.samples) {
      const int u0 = static_cast<int>(sample % width) * factor;
      const int v0 = static_cast<int>(sample / width) * factor;
      // What lies beside a plane's samples belongs to it if it is in the plane, too.
      for (int v = v0 - factor; v < v0 + 2 * factor; ++v) {
        for (int u = u0 - factor; u < u0 + 2 * factor; ++u) {
          if (!view.contains(u, v)) continue;
          float& here = depth[view.index(u, v)];
          const Eigen::Vector3f ray = view.camera.back_project(u, v, 1.0).cast<float>();
          if (here > 0.0F && std::abs(1.0F / here - region.m.dot(ray)) < tolerance) here = 0.0F;
        }
      }
    }
  }
  return depth;
}

}  // namespace lockbox
