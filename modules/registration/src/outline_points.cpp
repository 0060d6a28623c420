// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/outline_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "outline.hpp"

namespace lockbox {
namespace {

constexpr int kRowsInBand = 16;
/// How far beside an outline the field is asked: near an edge tri-linear distances and gradients
/// err, the nearer the more.
constexpr double kVoxelsAside = 3.0;
constexpr double kPixelsBeyond = 1.5;    // an outline: where something farther away is to be seen
constexpr double kLeastAgreement = 0.5;  // of the field's normal with the z-buffer's: a cosine
constexpr int kProjections = 4;
constexpr int kMostSteps = 20;
constexpr double kStep = 0.004;  // metres
constexpr float kJump = 1e-3F;   // of the depth: no outline is lower

/// Unit vector in the camera's frame that moves a point at p along a direction of the image, across
/// its ray.
Eigen::Vector3d across_ray(const Eigen::Vector3d& p, const PinholeCamera& camera,
                           const Eigen::Vector2d& direction) {
  const Eigen::Vector3d along_image(direction.x() / camera.fx, direction.y() / camera.fy, 0.0);
  const Eigen::Vector3d ray = p.normalized();
  return (along_image - ray.dot(along_image) * ray).normalized();
}

/// Whether a neighbour in the view lies farther away.
bool is_at_jump(const RenderedDepth& view, int u, int v) {
  const float farther = view.depth[view.index(u, v)] * (1.0F + kJump);
  return view.depth[view.index(u - 1, v)] > farther || view.depth[view.index(u + 1, v)] > farther ||
         view.depth[view.index(u, v - 1)] > farther || view.depth[view.index(u, v + 1)] > farther;
}

/// Finds the outlines of one view.
class OutlineFinder {
 public:
  OutlineFinder(const ArticulatedModel& model, const VisibleSurface& surface,
                const RegistrationOptions& options)
      : model_(model),
        surface_(surface),
        view_(surface.view()),
        camera_(surface.view_camera()),
        options_(options) {}

  /// The outline beside a pixel that shows a body, if one passes there. The z-buffer's pixels tell
  /// it only coarsely, the body's field precisely: nothing where the two disagree.
  std::optional<OutlinePoint> find(int u, int v) const {
    const TangentPlane plane(view_, u, v);
    if (!ends_beside(plane, u, v)) {
      return std::nullopt;
    }
    const Eigen::Vector2d coarse_in_image = outline_normal(view_, plane, u, v, 1.0 / camera_.fx);
    if (coarse_in_image.isZero()) {
      return std::nullopt;
    }
    const std::size_t index = view_.index(u, v);
    const auto body = static_cast<std::size_t>(view_.id[index]);
    const Eigen::Vector3d p = camera_.back_project(u, v, static_cast<double>(view_.depth[index]));
    const Eigen::Vector3d coarse = across_ray(p, camera_, coarse_in_image);
    const double aside = p.z() / camera_.fx + kVoxelsAside * model_.fields[body]->voxel();
    const Eigen::Vector3d ray = (p + aside * coarse).normalized();
    const Touch touch = slide_back(body, touch_nearest(body, p + aside * coarse, ray), ray);
    const Eigen::Vector3d across = touch.normal - ray.dot(touch.normal) * ray;
    if (across.dot(coarse) < kLeastAgreement || !stands_out(touch.p, across)) {
      return std::nullopt;
    }
    const Eigen::Isometry3d& T_body_camera = surface_.T_body_camera()[body];
    const Eigen::Vector3d normal = across.normalized();
    return OutlinePoint{T_body_camera * touch.p,
                        T_body_camera.linear() * normal,
                        plane.slopes().dot(normal.head<2>()) * camera_.fx / p.z(),
                        plane.steepness() / surface_.reduction(),
                        std::max(0.0, touch.p.z() - p.z()),
                        static_cast<double>(surface_.reduction()),
                        static_cast<int>(body)};
  }

 private:
  /// A point of a body's surface and the outward normal there, in the camera's frame.
  struct Touch {
    Eigen::Vector3d p;
    Eigen::Vector3d normal;
  };

  bool ends_beside(const TangentPlane& plane, int u, int v) const {
    constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const auto depth = static_cast<double>(view_.depth[view_.index(u, v)]);
    return std::any_of(kBeside.begin(), kBeside.end(), [&](const auto& d) {
      const auto there = static_cast<double>(view_.depth[view_.index(u + d[0], v + d[1])]);
      return there > depth * (plane.relative_depth(d[0], d[1]) + 1.0 / camera_.fx);
    });
  }

  /// Where a body comes nearest to p, and how far that is.
  std::pair<Touch, double> nearest(std::size_t body, const Eigen::Vector3d& p) const {
    const Eigen::Isometry3d& T_body_camera = surface_.T_body_camera()[body];
    const DistanceSample at = model_.fields[body]->sample((T_body_camera * p).cast<float>());
    const Eigen::Vector3d normal =
        (T_body_camera.linear().transpose() * at.gradient.cast<double>()).normalized();
    const auto distance = static_cast<double>(at.distance);
    return {{p - distance * normal, normal}, distance};
  }

  /// Where a body comes nearest to a ray that passes beside it, by alternating projections.
  Touch touch_nearest(std::size_t body, Eigen::Vector3d beside, const Eigen::Vector3d& ray) const {
    Touch touch{beside, Eigen::Vector3d::Zero()};
    for (int k = 0; k < kProjections; ++k) {
      touch = nearest(body, beside).first;
      beside = ray.dot(touch.p) * ray;
    }
    return touch;
  }

  /// On along a side that is turned to the camera, to where it ends.
  Touch slide_back(std::size_t body, Touch touch, const Eigen::Vector3d& ray) const {
    for (int k = 0; k < kMostSteps; ++k) {
      const auto [behind, distance] = nearest(body, touch.p + kStep * ray);
      if (distance >= 0.0) break;
      touch = behind;
    }
    return touch;
  }

  /// Whether what the view shows just beyond the outline lies behind it by more than noise.
  bool stands_out(const Eigen::Vector3d& p, const Eigen::Vector3d& outwards) const {
    const Eigen::Vector2d beyond = camera_.project(p) +
                                   kPixelsBeyond * outwards.head<2>().normalized() +
                                   Eigen::Vector2d(0.5, 0.5);
    const int u = static_cast<int>(beyond.x());
    const int v = static_cast<int>(beyond.y());
    return u >= 0 && v >= 0 && u < view_.width &&
           v<view_.height&& static_cast<double>(view_.depth[view_.index(u, v)])> p.z() +
               options_.free_space_dead_zone * options_.noise.sigma_z(p.z());
  }

  const ArticulatedModel& model_;
  const VisibleSurface& surface_;
  const RenderedDepth& view_;
  const PinholeCamera& camera_;
  const RegistrationOptions& options_;
};

}  // namespace

void OutlinePoints::collect(const ArticulatedModel& model, const VisibleSurface& surface,
                            const RegistrationOptions& options, const Executor& executor) {
  const RenderedDepth& view = surface.view();
  const OutlineFinder finder(model, surface, options);
  bands_.resize(static_cast<std::size_t>((view.height + kRowsInBand - 1) / kRowsInBand));
  executor.for_each(bands_.size(), [&](std::size_t band) {
    bands_[band].clear();
    const int first = static_cast<int>(band) * kRowsInBand;
    for (int v = std::max(first, 1); v < std::min(first + kRowsInBand, view.height - 1); ++v) {
      for (int u = 1; u + 1 < view.width; ++u) {
        if (view.id[view.index(u, v)] == kNothing || !is_at_jump(view, u, v)) continue;
        if (const auto point = finder.find(u, v)) bands_[band].push_back(*point);
      }
    }
  });
}

}  // namespace lockbox
