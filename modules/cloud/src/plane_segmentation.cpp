// SPDX-License-Identifier: BSD-3-Clause
#include "plane_segmentation.hpp"

#include <pcl/ModelCoefficients.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

/// Length that makes 1/depth a coordinate like the others: so small that planes are seldom steep
/// in it, and distances from them are differences in 1/depth. Metres.
constexpr float kInverseDepthScale = 0.1F;
/// In standard deviations: what supports a plane, and what is not looked at again for the next.
constexpr double kSupport = 1.5;
constexpr double kExplained = 2.5;
/// Share of the samples below which a plane is not worth finding.
constexpr double kMinSupport = 0.02;
constexpr int kMaxTrials = 150;
/// Every fourth sample is enough to find a plane by.
constexpr std::size_t kThinning = 4;

Eigen::Vector3f ray_of(const pcl::PointXYZ& point) {
  return {point.x / point.z, point.y / point.z, 1.0F};
}

pcl::PointCloud<pcl::PointXYZ>::Ptr ray_coordinates(const SampleGrid& grid,
                                                    const std::vector<int>& samples) {
  auto rays = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  rays->reserve(samples.size() / kThinning + 1);
  for (std::size_t i = 0; i < samples.size(); i += kThinning) {
    const pcl::PointXYZ& point = (*grid.points)[static_cast<std::size_t>(samples[i])];
    rays->push_back({point.x / point.z, point.y / point.z, kInverseDepthScale / point.z});
  }
  return rays;
}

/// From a x + b y + c w + d = 0 in ray coordinates; nothing for a plane through the camera.
bool to_plane(const std::vector<float>& abcd, Plane& plane) {
  if (abcd.size() != 4 || std::abs(abcd[2]) < 1e-3F) {
    return false;
  }
  plane.m = Eigen::Vector3f(abcd[0], abcd[1], abcd[3]) / (-abcd[2] * kInverseDepthScale);
  return true;
}

void remove_explained(const Plane& plane, double noise, const pcl::PointCloud<pcl::PointXYZ>& rays,
                      std::vector<int>& remaining) {
  const auto is_explained = [&](int i) {
    const pcl::PointXYZ& ray = rays[static_cast<std::size_t>(i)];
    return plane.residual({ray.x, ray.y, 1.0F}, ray.z / kInverseDepthScale) < kExplained * noise;
  };
  remaining.erase(std::remove_if(remaining.begin(), remaining.end(), is_explained),
                  remaining.end());
}

}  // namespace

// pcl::SACSegmentation: RANSAC with a fixed seed, a few milliseconds on these few points.
// pcl::OrganizedMultiPlaneSegmentation needs normals first (36 ms), and those of noisy points
// cannot tell two parallel planes from one.
std::vector<Plane> find_planes(const SampleGrid& grid, const std::vector<int>& samples,
                               double noise) {
  const auto rays = ray_coordinates(grid, samples);
  const auto remaining = pcl::make_shared<std::vector<int>>();
  for (std::size_t i = 0; i < rays->size(); ++i) {
    remaining->push_back(static_cast<int>(i));
  }
  const auto min_support =
      std::max<std::size_t>(10, static_cast<std::size_t>(kMinSupport * double(rays->size())));
  pcl::SACSegmentation<pcl::PointXYZ> ransac;
  ransac.setModelType(pcl::SACMODEL_PLANE);
  ransac.setMethodType(pcl::SAC_RANSAC);
  ransac.setDistanceThreshold(kSupport * noise * double{kInverseDepthScale});
  ransac.setMaxIterations(kMaxTrials);
  ransac.setInputCloud(rays);
  std::vector<Plane> planes;
  while (planes.size() < kMaxPlanes && remaining->size() >= min_support) {
    pcl::PointIndices support;
    pcl::ModelCoefficients coefficients;
    ransac.setIndices(remaining);
    ransac.segment(support, coefficients);
    Plane plane;
    if (support.indices.size() < min_support || !to_plane(coefficients.values, plane)) {
      break;
    }
    planes.push_back(plane);
    remove_explained(plane, noise, *rays, *remaining);
  }
  return planes;
}

int nearest_plane(const std::vector<Plane>& planes, const Eigen::Vector3f& ray, float inverse_depth,
                  float tolerance) {
  int nearest = -1;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const float residual = planes[i].residual(ray, inverse_depth);
    if (residual < tolerance) {
      tolerance = residual;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

std::vector<int> surface_planes(const SampleGrid& grid, const std::vector<Plane>& planes,
                                float tolerance) {
  std::vector<int> nearest(grid.size(), -1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (grid.is_measured(i)) {
      const pcl::PointXYZ& point = (*grid.points)[i];
      nearest[i] = nearest_plane(planes, ray_of(point), 1.0F / point.z, tolerance);
    }
  }
  std::vector<int> surface(grid.size(), -1);
  const int columns = grid.columns;
  for (int row = 1; row + 1 < grid.rows; ++row) {
    for (int column = 1; column + 1 < columns; ++column) {
      const std::size_t here = grid.index(column, row);
      const std::array<std::size_t, 4> neighbours{
          grid.index(column - 1, row), grid.index(column + 1, row), grid.index(column, row - 1),
          grid.index(column, row + 1)};
      const bool inside =
          std::all_of(neighbours.begin(), neighbours.end(), [&](std::size_t neighbour) {
            return nearest[neighbour] == nearest[here] || !grid.is_measured(neighbour);
          });
      surface[here] = inside ? nearest[here] : -1;
    }
  }
  return surface;
}

}  // namespace lockbox
