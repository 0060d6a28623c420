// SPDX-License-Identifier: BSD-3-Clause
#include "height_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

constexpr float kSlack = 0.006F;  // metres that plane and template may be off
constexpr float kGate = 3.0F;     // standard deviations
constexpr int kMostCells = 224;   // along each side, without margins
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

Eigen::AlignedBox2d region_bounds(const CoarseView& view, const PlanarRegion& region,
                                  const Eigen::Isometry3d& T_plane_camera) {
  Eigen::AlignedBox2d box;
  const auto width = static_cast<std::size_t>(view.camera.width);
  for (const std::size_t sample : region.samples) {
    const Eigen::Vector3d p = T_plane_camera * view.point(static_cast<int>(sample % width),
                                                          static_cast<int>(sample / width))
                                                   .cast<double>();
    box.extend(p.head<2>());
  }
  return box;
}

/// Looks through each cell of the plane.
void look_through(const CoarseView& view, double noise, HeightMap& map) {
  const Eigen::Isometry3d& T_camera_plane = map.T_camera_plane;
  const Eigen::Vector3d normal = T_camera_plane.linear().col(2);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const Eigen::Vector2d cell = map.corner + map.cell_size * Eigen::Vector2d(x, y);
      const Eigen::Vector3d p = T_camera_plane * Eigen::Vector3d(cell.x(), cell.y(), 0.0);
      // Metres: nearer than what depth cameras measure.
      if (p.z() < 0.1) continue;
      const Eigen::Vector2d image = view.camera.project(p);
      const auto u = static_cast<int>(std::lround(image.x()));
      const auto v = static_cast<int>(std::lround(image.y()));
      if (!view.contains(u, v)) continue;
      const auto z = static_cast<double>(view.depth[view.index(u, v)]);
      if (!(z > 0.0)) continue;
      // The same ray, to the sub-pixel, at the measured depth.
      const Eigen::Vector3d ray = p / p.z();
      const double slope = std::abs(normal.dot(ray));
      const auto sigma = static_cast<float>(slope * noise * z * z) + kSlack;
      const auto over = static_cast<float>(normal.dot((z - p.z()) * ray));
      const std::size_t i = map.index(x, y);
      if (over > kGate * sigma) continue;  // something in front: it lies over another cell
      map.heights[i] = over < -kGate * sigma - kDeepest ? kBelow : over;
      map.sigmas[i] = sigma;
    }
  }
}

/// Drops what stands out of the plane onto its cells; the highest counts.
void drop_points(const CoarseView& view, double noise, HeightMap& map) {
  const Eigen::Isometry3f T = map.T_camera_plane.inverse().cast<float>();
  for (int v = 0; v < view.camera.height; ++v) {
    for (int u = 0; u < view.camera.width; ++u) {
      const float z = view.depth[view.index(u, v)];
      if (!(z > 0.0F)) continue;
      const Eigen::Vector3f p_camera = view.point(u, v);
      const Eigen::Vector3f p = T * p_camera;
      const float slope = std::abs(T.linear().row(2).dot(p_camera / z));
      const float sigma = slope * static_cast<float>(noise) * z * z + kSlack;
      if (p.z() < kGate * sigma) continue;
      const auto x =
          static_cast<int>(std::lround((double{p.x()} - map.corner.x()) / map.cell_size));
      const auto y =
          static_cast<int>(std::lround((double{p.y()} - map.corner.y()) / map.cell_size));
      if (x < 0 || y < 0 || x >= map.width || y >= map.height) continue;
      const std::size_t i = map.index(x, y);
      if (!(map.heights[i] > p.z())) {
        map.heights[i] = p.z();
        map.sigmas[i] = sigma;
      }
    }
  }
}

}  // namespace

HeightMap height_map(const CoarseView& view, const PlanarRegion& region, double noise,
                     const HeightMapSize& size) {
  const Eigen::Isometry3d T_camera_plane = region_frame(view, region);
  const Eigen::AlignedBox2d box = region_bounds(view, region, T_camera_plane.inverse());
  const auto cells_for = [&](double length) {
    return std::min(static_cast<int>((length + 2.0 * size.beyond) / size.cell) + 1, kMostCells) +
           2 * size.margin;
  };
  HeightMap map{T_camera_plane,
                cells_for(box.sizes().x()),
                cells_for(box.sizes().y()),
                size.margin,
                {},
                size.cell,
                {},
                {}};
  map.corner = box.center() - 0.5 * size.cell * Eigen::Vector2d(map.width - 1, map.height - 1);
  const auto cells = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  map.heights.assign(cells, kUnknown);
  map.sigmas.assign(cells, 1.0F);
  look_through(view, noise, map);
  drop_points(view, noise, map);
  return map;
}

}  // namespace lockbox
