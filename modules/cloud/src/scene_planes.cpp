// SPDX-License-Identifier: BSD-3-Clause
#include "scene_planes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lockbox {
namespace {

constexpr double kMaxShareElsewhere = 0.25;
constexpr int kDirections = 8;      ///< in which widths are compared, over half a turn
constexpr double kOutliers = 0.02;  ///< share left out at each end of a surface

std::vector<Eigen::Vector3f> points_of(int plane, const SampleGrid& grid,
                                       const std::vector<int>& surface) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (surface[i] == plane) {
      points.emplace_back((*grid.points)[i].getVector3fMap());
    }
  }
  return points;
}

double width_along(const Eigen::Vector3f& direction, const std::vector<Eigen::Vector3f>& points,
                   double outliers) {
  std::vector<float> along(points.size());
  std::transform(points.begin(), points.end(), along.begin(),
                 [&](const Eigen::Vector3f& point) { return direction.dot(point); });
  const auto cut = static_cast<std::ptrdiff_t>(outliers * static_cast<double>(along.size()));
  const auto nth = [&](std::ptrdiff_t n) {
    std::nth_element(along.begin(), along.begin() + n, along.end());
    return static_cast<double>(along[static_cast<std::size_t>(n)]);
  };
  const double low = nth(cut);
  return nth(static_cast<std::ptrdiff_t>(along.size()) - 1 - cut) - low;
}

std::vector<Eigen::Vector3f> corners_of(const std::vector<ExpectedBody>& bodies) {
  std::vector<Eigen::Vector3f> corners;
  for (const ExpectedBody& body : bodies) {
    for (int corner = 0; corner < 8 && !body.box.isEmpty(); ++corner) {
      const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
      corners.emplace_back((body.T_camera_body * body.box.corner(type)).cast<float>());
    }
  }
  return corners;
}

bool is_wider(const Plane& plane, const std::vector<Eigen::Vector3f>& points,
              const std::vector<Eigen::Vector3f>& object_corners, double margin) {
  const Eigen::Vector3f normal = plane.m.normalized();
  const Eigen::Vector3f first = normal.unitOrthogonal();
  const Eigen::Vector3f second = normal.cross(first);
  for (int i = 0; i < kDirections; ++i) {
    const auto angle = static_cast<float>(std::numbers::pi * i / kDirections);
    const Eigen::Vector3f direction = std::cos(angle) * first + std::sin(angle) * second;
    if (width_along(direction, points, kOutliers) >
        width_along(direction, object_corners, 0.0) + margin) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::uint8_t> scene_planes(const SampleGrid& grid, const std::vector<Plane>& planes,
                                       const std::vector<int>& surface,
                                       const std::vector<std::uint8_t>& near_object,
                                       const std::vector<ExpectedBody>& bodies, double margin) {
  const std::vector<Eigen::Vector3f> object_corners = corners_of(bodies);
  std::vector<std::size_t> elsewhere(planes.size(), 0);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (surface[i] >= 0 && near_object[i] == 0) {
      ++elsewhere[static_cast<std::size_t>(surface[i])];
    }
  }
  std::vector<std::uint8_t> is_scene(planes.size(), 0);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const auto points = points_of(static_cast<int>(i), grid, surface);
    if (points.empty()) {
      continue;
    }
    const double share = static_cast<double>(elsewhere[i]) / static_cast<double>(points.size());
    is_scene[i] =
        share > kMaxShareElsewhere || is_wider(planes[i], points, object_corners, margin) ? 1 : 0;
  }
  return is_scene;
}

}  // namespace lockbox
