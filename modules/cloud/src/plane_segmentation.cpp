// SPDX-License-Identifier: BSD-3-Clause
#include "plane_segmentation.hpp"

#include <pcl/sample_consensus/msac.h>
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
/// Planes are found by the means of so many by so many samples. The noise of neighbours goes
/// together: what is left of its standard deviation is this share.
constexpr int kBlock = 3;
constexpr double kBlockNoise = 0.6;
/// Second difference of 1/depth that is still noise, in standard deviations of a sample (3 sigma of
/// the difference of independent ones).
constexpr double kMaxBend = 8.0;
/// In standard deviations of a block: what supports a plane, and what is not looked at again for
/// the next.
constexpr double kSupport = 1.5;
constexpr double kExplained = 4.0;
/// Share of the blocks below which a plane is not worth finding.
constexpr double kMinSupport = 0.02;
constexpr int kRefinements = 2;
/// Twice the area of the triangle of three points that are drawn, for rays at unit depth.
constexpr float kMinSpread = 0.01F;
constexpr int kMaxTrials = 300;
/// That a trial hits the plane; so high because the best of many trials is the more exact one, and
/// an inexact one joins two parallel planes.
constexpr double kSuccess = 0.999999;

Eigen::Vector3f ray_of(const pcl::PointXYZ& point) {
  return {point.x / point.z, point.y / point.z, 1.0F};
}

/// The mean of a block of 3 x 3 samples in ray coordinates, which lies on the plane that they lie
/// on; nothing if some are not measured or an edge runs through them.
std::optional<Eigen::Vector3f> block_mean(const SampleGrid& grid, int column, int row,
                                          double noise) {
  Eigen::Matrix3f inverse_depth;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (int r = 0; r < kBlock; ++r) {
    for (int c = 0; c < kBlock; ++c) {
      const pcl::PointXYZ& point = (*grid.points)[grid.index(column + c, row + r)];
      inverse_depth(r, c) = 1.0F / point.z;
      mean += Eigen::Vector3f(point.x, point.y, kInverseDepthScale) / (9.0F * point.z);
    }
  }
  const auto bend = [&](const Eigen::Vector3f& line) {
    return std::abs(line[0] - 2.0F * line[1] + line[2]);
  };
  const auto max_bend = static_cast<float>(kMaxBend * noise);
  for (int i = 0; i < kBlock; ++i) {
    if (!(bend(inverse_depth.row(i)) < max_bend && bend(inverse_depth.col(i)) < max_bend)) {
      return std::nullopt;
    }
  }
  return mean;
}

pcl::PointCloud<pcl::PointXYZ>::Ptr ray_coordinates(const SampleGrid& grid, double noise) {
  auto rays = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (int row = 0; row + kBlock <= grid.rows; row += kBlock) {
    for (int column = 0; column + kBlock <= grid.columns; column += kBlock) {
      if (const auto mean = block_mean(grid, column, row, noise)) {
        rays->push_back({mean->x(), mean->y(), mean->z()});
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

/// Makes the plane of a x + b y + c w + d = 0 in ray coordinates; nothing for a plane through the
/// camera.
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
  pcl::MEstimatorSampleConsensus<pcl::PointXYZ> consensus(model, threshold);
  consensus.setMaxIterations(kMaxTrials);
  consensus.setProbability(kSuccess);
  if (!consensus.computeModel()) {
    return std::nullopt;
  }
  Eigen::VectorXf coefficients;
  consensus.getModelCoefficients(coefficients);
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

// pcl::MEstimatorSampleConsensus, seeded, a few milliseconds on these few points: it scores by
// squared distances, where pcl::RandomSampleConsensus counts points and so prefers a plane that
// cuts through two parallel ones. pcl::SACSegmentation wraps both, but draws from a model of its
// own. pcl::OrganizedMultiPlaneSegmentation needs normals first (36 ms), and those of noisy points
// cannot tell two parallel planes from one.
std::vector<Plane> find_planes(const SampleGrid& grid, double noise) {
  const auto rays = ray_coordinates(grid, noise);
  const double block_noise = kBlockNoise * noise;
  pcl::Indices remaining(rays->size());
  std::iota(remaining.begin(), remaining.end(), 0);
  const auto min_support =
      std::max<std::size_t>(10, static_cast<std::size_t>(kMinSupport * double(rays->size())));
  std::vector<Plane> planes;
  while (planes.size() < kMaxPlanes && remaining.size() >= min_support) {
    const auto plane = largest_plane(rays, remaining, block_noise, min_support);
    if (!plane) {
      break;
    }
    planes.push_back(*plane);
    remove_explained(*plane, block_noise, *rays, remaining);
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
