// SPDX-License-Identifier: BSD-3-Clause
#include "oriented_points.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "lockbox/core/lie.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {
namespace {

/// Samples, of the window of a fit: in fewer, noise turns normals by more than a bin; more take
/// time.
constexpr int kLeastRadius = 2;
constexpr int kMostRadius = 8;
constexpr std::size_t kLeastFit = 8;  // samples that make a plane: of a window's 13, most
/// Of the spacing, in depth: what belongs to one surface. Doubled, a handle and what is behind it
/// are taken for one slope.
constexpr double kSurface = 1.5;
constexpr double kSteepestSeen = 0.17;  // cosine of 80 degrees: beyond, it is an edge that is seen
/// From which a model is looked at: no two are more than 40 degrees apart, and a surface that is
/// steep in one is not in the next.
constexpr int kDirections = 32;
constexpr double kAway = 6.0;          // diameters, from where it is: nearly parallel rays
constexpr double kSamplesAStep = 3.0;  // of the image of a model, from one point to the next
/// What is told apart of points from several directions, in shares of the spacing, and the cosine
/// of 30 degrees, two bins of PointPairs.
constexpr float kSamePoint = 0.75F;
constexpr float kSameNormal = 0.87F;

/// Fits planes m.r = 1/depth around samples.
class PlaneFit {
 public:
  PlaneFit(const DepthView& view, double spacing) : view_(view), spacing_(spacing) {}

  std::optional<OrientedPoint> at(int u, int v) const {
    const double z = depth(u, v);
    const double gate = kSurface * spacing_ + 3.0 * view_.noise * z * z;
    const int radius = std::clamp(static_cast<int>(std::lround(spacing_ * view_.camera.fx / z)),
                                  kLeastRadius, kMostRadius);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (int dv = -radius; dv <= radius; ++dv) {
      for (int du = -radius; du <= radius; ++du) {
        if (du * du + dv * dv > radius * radius || !contains(u + du, v + dv)) continue;
        const double there = depth(u + du, v + dv);
        if (!(there > 0.0) || std::abs(there - z) > gate) continue;
        const Eigen::Vector3d ray = view_.camera.back_project(u + du, v + dv, 1.0);
        moments.selfadjointView<Eigen::Lower>().rankUpdate(ray);
        right += ray / there;
        ++count;
      }
    }
    if (count < kLeastFit) return std::nullopt;
    const Eigen::Vector3d m = moments.selfadjointView<Eigen::Lower>().ldlt().solve(right);
    const Eigen::Vector3d ray = view_.camera.back_project(u, v, 1.0);
    const double inverse = m.dot(ray);
    if (!m.allFinite() || !(inverse > kSteepestSeen * m.norm() * ray.norm())) return std::nullopt;
    if (std::abs(1.0 / inverse - z) > gate) return std::nullopt;
    return OrientedPoint{(ray / inverse).cast<float>(), -m.normalized().cast<float>()};
  }

  double depth(int u, int v) const {
    return static_cast<double>(
        view_.depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(view_.camera.width) +
                    static_cast<std::size_t>(u)]);
  }

 private:
  bool contains(int u, int v) const {
    return u >= 0 && v >= 0 && u < view_.camera.width && v < view_.camera.height;
  }

  const DepthView& view_;
  double spacing_;
};

/// Spread evenly over the sphere (a golden spiral).
Eigen::Vector3d direction(int number) {
  const double z = 1.0 - (2.0 * number + 1.0) / kDirections;
  const double angle = number * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

/// Adds those that are not there yet.
void add_new(const std::vector<OrientedPoint>& seen, const Eigen::Isometry3d& T_body_camera,
             double spacing, std::vector<OrientedPoint>& points) {
  const Eigen::Isometry3f T = T_body_camera.cast<float>();
  const float apart = kSamePoint * static_cast<float>(spacing);
  for (const OrientedPoint& point : seen) {
    const OrientedPoint turned{T * point.position, T.linear() * point.normal};
    const bool is_known =
        std::any_of(points.begin(), points.end(), [&](const OrientedPoint& other) {
          return (other.position - turned.position).squaredNorm() < apart * apart &&
                 other.normal.dot(turned.normal) > kSameNormal;
        });
    if (!is_known) points.push_back(turned);
  }
}

}  // namespace

std::vector<OrientedPoint> points_of_view(const DepthView& view, double spacing) {
  const PlaneFit fit(view, spacing);
  std::vector<OrientedPoint> points;
  for (int v = 0; v < view.camera.height; ++v) {
    for (int u = 0; u < view.camera.width; ++u) {
      const double z = fit.depth(u, v);
      if (!(z > 0.0)) continue;
      const int stride = std::max(1, static_cast<int>(spacing * view.camera.fx / z));
      if (u % stride != 0 || v % stride != 0) continue;
      if (const auto point = fit.at(u, v)) points.push_back(*point);
    }
  }
  return points;
}

std::vector<OrientedPoint> points_of_body(const KinematicTree& tree, std::size_t body,
                                          double spacing, const Executor& executor) {
  const Eigen::AlignedBox3d box = bounds(tree.bodies[body].mesh);
  const double diameter = box.diagonal().norm();
  const double focal = kSamplesAStep * kAway * diameter / spacing;
  const int size = static_cast<int>(focal / (kAway - 0.5)) + 2;
  const PinholeCamera camera{size, size, focal, focal, 0.5 * (size - 1), 0.5 * (size - 1)};
  DepthRenderer renderer(camera, executor);
  RenderedDepth image;
  std::vector<OrientedPoint> points;
  for (int number = 0; number < kDirections; ++number) {
    Eigen::Isometry3d T_camera_body = Eigen::Isometry3d::Identity();
    T_camera_body.linear() =
        Eigen::Quaterniond::FromTwoVectors(direction(number), -Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
    T_camera_body.translation() =
        kAway * diameter * Eigen::Vector3d::UnitZ() - T_camera_body.linear() * box.center();
    const std::vector<RenderItem> items{body_item(tree, body, T_camera_body)};
    renderer.render(items, image);
    std::replace_if(
        image.depth.begin(), image.depth.end(), [](float z) { return !std::isfinite(z); }, 0.0F);
    add_new(points_of_view({camera, image.depth}, spacing), T_camera_body.inverse(), spacing,
            points);
  }
  return points;
}

}  // namespace lockbox
