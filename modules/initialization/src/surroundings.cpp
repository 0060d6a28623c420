// SPDX-License-Identifier: BSD-3-Clause
#include "surroundings.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kPoints = 48;  // stand for a region
constexpr double kReach = 0.06;      // metres: what hypotheses are off by
constexpr double kMost = 0.5;        // share of a region
constexpr double kOnPlane = 4.0;     // standard deviations

std::vector<Eigen::Vector3d> some_points(const CoarseView& view, const PlanarRegion& region) {
  const auto width = static_cast<std::size_t>(view.camera.width);
  const std::size_t step = std::max<std::size_t>(1, region.samples.size() / kPoints);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < region.samples.size(); i += step) {
    const std::size_t sample = region.samples[i];
    points.push_back(view.point(static_cast<int>(sample % width), static_cast<int>(sample / width))
                         .cast<double>());
  }
  return points;
}

/// What lies in no region is given to one beside it: there surfaces end, and pixels of both meet.
std::vector<std::int16_t> widened(const CoarseView& view, const std::vector<std::int16_t>& region) {
  std::vector<std::int16_t> wider = region;
  for (int v = 0; v < view.camera.height; ++v) {
    for (int u = 0; u < view.camera.width; ++u) {
      if (region[view.index(u, v)] >= 0) continue;
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          if (!view.contains(u + du, v + dv)) continue;
          wider[view.index(u, v)] =
              std::max(wider[view.index(u, v)], region[view.index(u + du, v + dv)]);
        }
      }
    }
  }
  return wider;
}

}  // namespace

Surroundings::Surroundings(const KinematicTree& tree) : tree_(tree) {
  for (const Body& body : tree.bodies) boxes_.push_back(bounds(body.mesh));
}

void Surroundings::set_scene(const PlanarScene& scene) {
  camera_ = scene.view.camera;
  planes_.clear();
  points_.clear();
  std::vector<std::int16_t> region_at(scene.view.depth.size(), -1);
  for (std::size_t r = 0; r < scene.regions.size(); ++r) {
    const PlanarRegion& region = scene.regions[r];
    planes_.push_back(region.m);
    points_.push_back(some_points(scene.view, region));
    for (const std::size_t sample : region.samples) {
      region_at[sample] = static_cast<std::int16_t>(r);
    }
  }
  region_at_ = widened(scene.view, region_at);
}

std::vector<std::uint8_t> Surroundings::planes_elsewhere(const Configuration& configuration) const {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(tree_, configuration, poses);
  for (Eigen::Isometry3d& pose : poses) pose = pose.inverse();
  const auto is_elsewhere = [&](const Eigen::Vector3d& p_camera) {
    for (std::size_t b = 0; b < poses.size(); ++b) {
      if (!boxes_[b].isEmpty() && boxes_[b].exteriorDistance(poses[b] * p_camera) < kReach) {
        return false;
      }
    }
    return true;
  };
  std::vector<std::uint8_t> planes(planes_.size());
  std::transform(points_.begin(), points_.end(), planes.begin(), [&](const auto& points) {
    const auto elsewhere = std::count_if(points.begin(), points.end(), is_elsewhere);
    return static_cast<double>(elsewhere) > kMost * static_cast<double>(points.size()) ? 1 : 0;
  });
  return planes;
}

const TiledCloud& Surroundings::left_out_of(const TiledCloud& cloud,
                                            const Configuration& configuration, double noise,
                                            PartOfCloud& part) const {
  const auto elsewhere = planes_elsewhere(configuration);
  if (std::find(elsewhere.begin(), elsewhere.end(), 1) == elsewhere.end()) return cloud;
  const PinholeCamera& camera = cloud.camera();
  const int factor = camera.width / camera_.width;
  const auto tolerance = static_cast<float>(kOnPlane * noise);
  part.mask.assign(cloud.depth().size(), 1);
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height; ++v) {
    const auto row = static_cast<std::size_t>(std::min(v / factor, camera_.height - 1)) *
                     static_cast<std::size_t>(camera_.width);
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const auto column = static_cast<std::size_t>(std::min(u / factor, camera_.width - 1));
      const int region = region_at_[row + column];
      if (region < 0 || elsewhere[static_cast<std::size_t>(region)] == 0) continue;
      const Eigen::Vector3f ray = camera.back_project(u, v, 1.0).cast<float>();
      const float plane = planes_[static_cast<std::size_t>(region)].dot(ray);
      if (std::abs(1.0F / cloud.depth()[pixel] - plane) < tolerance) part.mask[pixel] = 0;
    }
  }
  part.cloud = cloud;
  part.cloud.keep(part.mask);
  return part.cloud;
}

}  // namespace lockbox
