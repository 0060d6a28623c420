// SPDX-License-Identifier: BSD-3-Clause
#include "plane_segmentation.hpp"

#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

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
constexpr int kRefinements = 2;
/// Twice the area of the triangle of three points that are drawn, for rays at unit depth.
constexpr float kMinSpread = 0.003F;
constexpr int kMaxTrials = 200;
/// That a trial hits the plane; so high because the best of many trials is the more exact one, and
/// an inexact one joins two parallel planes.
constexpr double kSuccess = 0.999999;

Eigen::Vector3f ray_of(const pcl::PointXYZ& point) {
  return {point.x / point.z, point.y / point.z, 1.0F};
}

/// Of every third measured sample of every third row: enough to find planes by.
pcl::PointCloud<pcl::PointXYZ>::Ptr ray_coordinates(const SampleGrid& grid) {
  auto rays = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (int row = 0; row < grid.rows; row += 3) {
    for (int column = 0; column < grid.columns; column += 3) {
      const std::size_t sample = grid.index(column, row);
      if (grid.is_measured(sample)) {
        const pcl::PointXYZ& point = (*grid.points)[sample];
        rays->push_back({point.x / point.z, point.y / point.z, kInverseDepthScale / point.z});
      }
    }
  }
  return rays;
}

/// Draws triples that are wide apart: they give a plane more exactly, and PCL complains on the
/// console about collinear ones, which are frequent where disparity is rounded.
class PlaneModel : public pcl::SampleConsensusModelPlane<pcl::PointXYZ> {
 public:
  using SampleConsensusModelPlane::SampleConsensusModelPlane;

 protected:
  bool isSampleGood(const pcl::Indices& samples) const override {
    const auto point = [&](std::size_t i) -> Eigen::Vector2f {
      return (*input_)[static_cast<std::size_t>(samples[i])].getVector3fMap().head<2>();
    };
    const Eigen::Vector2f first = point(1) - point(0);
    const Eigen::Vector2f second = point(2) - point(0);
    return std::abs(first.x() * second.y() - first.y() * second.x()) > kMinSpread;
  }
};

/// Of a x + b y + c w + d = 0 in ray coordinates; nothing for a plane through the camera.
std::optional<Plane> to_plane(const Eigen::VectorXf& abcd) {
  if (!abcd.allFinite() || std::abs(abcd[2]) < 1e-3F) {
    return std::nullopt;
  }
  return Plane{Eigen::Vector3f(abcd[0], abcd[1], abcd[3]) / (-abcd[2] * kInverseDepthScale)};
}

/// The plane with the largest support among the remaining points, if that is at least min_support.
std::optional<Plane> largest_plane(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& rays,
                                   const pcl::Indices& remaining, double noise,
                                   std::size_t min_support) {
  const double threshold = kSupport * noise * double{kInverseDepthScale};
  const auto model = pcl::make_shared<PlaneModel>(rays, remaining);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, threshold);
  ransac.setMaxIterations(kMaxTrials);
  ransac.setProbability(kSuccess);
  if (!ransac.computeModel()) {
    return std::nullopt;
  }
  Eigen::VectorXf coefficients;
  ransac.getModelCoefficients(coefficients);
  pcl::Indices support;
  for (int i = 0; i < kRefinements; ++i) {
    model->selectWithinDistance(coefficients, threshold, support);
    if (support.size() < min_support) {
      return std::nullopt;
    }
    Eigen::VectorXf refined;
    model->optimizeModelCoefficients(support, coefficients, refined);
    coefficients = refined;
  }
  return to_plane(coefficients);
}

void remove_explained(const Plane& plane, double noise, const pcl::PointCloud<pcl::PointXYZ>& rays,
                      pcl::Indices& remaining) {
  const auto is_explained = [&](int i) {
    const pcl::PointXYZ& ray = rays[static_cast<std::size_t>(i)];
    return plane.residual({ray.x, ray.y, 1.0F}, ray.z / kInverseDepthScale) < kExplained * noise;
  };
  remaining.erase(std::remove_if(remaining.begin(), remaining.end(), is_explained),
                  remaining.end());
}

}  // namespace

// pcl::RandomSampleConsensus, seeded, a few milliseconds on these few points; what
// pcl::SACSegmentation wraps, for the sake of the model above.
// pcl::OrganizedMultiPlaneSegmentation needs normals first (36 ms), and those of noisy points
// cannot tell two parallel planes from one.
std::vector<Plane> find_planes(const SampleGrid& grid, double noise) {
  const auto rays = ray_coordinates(grid);
  pcl::Indices remaining(rays->size());
  std::iota(remaining.begin(), remaining.end(), 0);
  const auto min_support =
      std::max<std::size_t>(10, static_cast<std::size_t>(kMinSupport * double(rays->size())));
  std::vector<Plane> planes;
  while (planes.size() < kMaxPlanes && remaining.size() >= min_support) {
    const auto plane = largest_plane(rays, remaining, noise, min_support);
    if (!plane) {
      break;
    }
    planes.push_back(*plane);
    remove_explained(*plane, noise, *rays, remaining);
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
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const int here = nearest[grid.index(column, row)];
      const auto in_plane = [&](int c, int r) {
        const bool in_image = c >= 0 && c < grid.columns && r >= 0 && r < grid.rows;
        return !in_image || !grid.is_measured(grid.index(c, r)) ||
               nearest[grid.index(c, r)] == here;
      };
      const bool inside = in_plane(column - 1, row) && in_plane(column + 1, row) &&
                          in_plane(column, row - 1) && in_plane(column, row + 1);
      surface[grid.index(column, row)] = inside ? here : -1;
    }
  }
  return surface;
}

}  // namespace lockbox
