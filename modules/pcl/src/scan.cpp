// SPDX-License-Identifier: BSD-3-Clause
#include "scan.hpp"

#include <cmath>
#include <limits>

#include "lockbox/core/pinhole_fit.hpp"

namespace lockbox {
namespace {

constexpr double kMaximumResidual = 1.0;  // pixels, root mean square, of a camera that was given
constexpr double kSameResidual = 0.02;    // pixels: less does not tell one view from another
constexpr double kFarthest = 1000.0;      // metres: what lies beyond was not measured
constexpr double kUsualFocal = 570.0;     // pixels, of a PrimeSense-class sensor

/// A place where the camera may stand, and how badly the points fit to it (pixels).
struct View {
  PinholeCamera camera;
  Eigen::Isometry3d T_camera_cloud;
  double residual;
};

template <typename Visit>
void for_each_pixel(const Scan& scan, const Eigen::Isometry3d& T_camera_cloud, const Visit& visit) {
  std::size_t i = 0;
  for (int v = 0; v < scan.height; ++v) {
    for (int u = 0; u < scan.width; ++u, ++i) {
      visit(u, v, T_camera_cloud * scan.points[i].cast<double>());
    }
  }
}

std::optional<View> fitted_view(const Scan& scan, const Eigen::Isometry3d& T_camera_cloud) {
  PinholeFit fit;
  for_each_pixel(scan, T_camera_cloud,
                 [&fit](int u, int v, const Eigen::Vector3d& p) { fit.add(u, v, p); });
  if (!fit.is_determined() || !fit.is_pinhole()) {
    return std::nullopt;
  }
  return View{fit.camera(scan.width, scan.height), T_camera_cloud, fit.residual()};
}

std::optional<View> given_view(const Scan& scan, const PinholeCamera& camera,
                               const Eigen::Isometry3d& T_camera_cloud) {
  double squares = 0.0;
  std::size_t count = 0;
  for_each_pixel(scan, T_camera_cloud, [&](int u, int v, const Eigen::Vector3d& p) {
    if (p.allFinite() && p.z() > 0.0) {
      squares += (camera.project(p) - Eigen::Vector2d(u, v)).squaredNorm();
      ++count;
    }
  });
  const double residual = std::sqrt(squares / static_cast<double>(count));
  if (!(residual <= kMaximumResidual)) {  // nor without points
    return std::nullopt;
  }
  return View{camera, T_camera_cloud, residual};
}

}  // namespace

std::optional<Eigen::Isometry3d> tile_image(const Scan& scan,
                                            const std::optional<PinholeCamera>& camera,
                                            const Executor& executor, TiledCloud& cloud) {
  if (scan.height < 2 ||
      (camera && (camera->width != scan.width || camera->height != scan.height))) {
    return std::nullopt;
  }
  const auto seen_from = [&](const Eigen::Isometry3d& T_cloud_camera) {
    const Eigen::Isometry3d T_camera_cloud = T_cloud_camera.inverse();
    return camera ? given_view(scan, *camera, T_camera_cloud) : fitted_view(scan, T_camera_cloud);
  };
  std::optional<View> best = seen_from(scan.T_cloud_sensor);
  if (!scan.T_cloud_sensor.isApprox(Eigen::Isometry3d::Identity())) {
    const std::optional<View> unmoved = seen_from(Eigen::Isometry3d::Identity());
    // What is flat fits to either; then the cloud is taken at its word.
    if (unmoved && (!best || unmoved->residual + kSameResidual < best->residual)) {
      best = unmoved;
    }
  }
  if (!best) {
    return std::nullopt;
  }
  std::vector<float> depth;
  depth.reserve(scan.points.size());
  for_each_pixel(scan, best->T_camera_cloud, [&depth](int, int, const Eigen::Vector3d& p) {
    depth.push_back(p.allFinite() ? static_cast<float>(p.z()) : 0.0F);
  });
  CloudOptions everything;
  everything.min_depth = 0.0;
  everything.max_depth = kFarthest;
  cloud.assign(best->camera, depth, everything, executor);
  if (!scan.used.empty()) {
    cloud.keep(scan.used);
  }
  return best->T_camera_cloud;
}

Eigen::Isometry3d tile_points(const Scan& scan, const std::optional<PinholeCamera>& camera,
                              const Eigen::Vector3d& center, TiledCloud& cloud) {
  Eigen::Isometry3d T_cloud_camera = Eigen::Isometry3d::Identity();
  T_cloud_camera.translation() = scan.T_cloud_sensor.translation();
  const Eigen::Vector3d direction = center - T_cloud_camera.translation();
  T_cloud_camera.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction).toRotationMatrix();
  const Eigen::Isometry3f T_camera_cloud = T_cloud_camera.inverse().cast<float>();

  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  std::vector<Eigen::Vector3f> points(scan.points.size(), Eigen::Vector3f::Constant(kUnknown));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((scan.used.empty() || scan.used[i] != 0) && scan.points[i].norm() < kFarthest) {
      points[i] = T_camera_cloud * scan.points[i];
    }
  }
  PinholeCamera view = camera.value_or(PinholeCamera{});
  if (!camera) {
    view.fx = view.fy = kUsualFocal;
  }
  cloud.assign_unorganized(points, view);
  return T_cloud_camera.inverse();
}

}  // namespace lockbox
