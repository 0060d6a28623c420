// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/outline_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
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
constexpr double kPixelsOff = 2.0;       // farther from the pixel it is another outline
constexpr double kLeastAgreement = 0.5;  // of the field's normal with the z-buffer's: a cosine
constexpr int kProjections = 4;
constexpr int kMostSteps = 20;
constexpr double kStep = 0.004;  // metres

/// Unit vector in the camera's frame that moves a point at p along a direction of the image, across
/// its ray.
Eigen::Vector3d across_ray(const Eigen::Vector3d& p, const PinholeCamera& camera,
                           const Eigen::Vector2d& direction) {
  const Eigen::Vector3d along_image(direction.x() / camera.fx, direction.y() / camera.fy, 0.0);
  const Eigen::Vector3d ray = p.normalized();
  return (along_image - ray.dot(along_image) * ray).normalized();
}

/// Marks the pixels of row v that have a neighbour which lies farther away by more than noise.
/// Without branches, so that it is done for many pixels at once.
void mark_jumps(const RenderedDepth& view, int v, const RegistrationOptions& options,
                std::vector<std::uint8_t>& is_at_jump) {
  const auto width = static_cast<std::size_t>(view.width);
  is_at_jump.assign(width, 0);
  const auto zone = static_cast<float>(options.free_space_dead_zone);
  const float floor = zone * static_cast<float>(options.noise.depth_floor);
  const float quadratic = zone * static_cast<float>(options.noise.depth_quadratic);
  const float* z = view.depth.data() + view.index(0, v);
  const float* above = view.depth.data() + view.index(0, v - 1);
  const float* below = view.depth.data() + view.index(0, v + 1);
  std::uint8_t* __restrict mark = is_at_jump.data();
  for (std::size_t u = 1; u + 1 < width; ++u) {
    const float farthest = std::max(std::max(z[u - 1], z[u + 1]), std::max(above[u], below[u]));
    mark[u] = static_cast<std::uint8_t>(farthest > z[u] + floor + quadratic * z[u] * z[u]);
  }
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
    const std::size_t index = view_.index(u, v);
    const auto depth = static_cast<double>(view_.depth[index]);
    const double jump = std::max(depth / camera_.fx, zone(depth)) / depth;
    const TangentPlane plane(view_, u, v);
    if (!ends_beside(plane, u, v, jump)) {
      return std::nullopt;
    }
    const Eigen::Vector2d coarse_in_image = outline_normal(view_, plane, u, v, jump);
    if (coarse_in_image.isZero()) {
      return std::nullopt;
    }
    const auto body = static_cast<std::size_t>(view_.id[index]);
    const SignedDistanceField& field = *model_.fields[body];
    const Eigen::Isometry3d& T_body_camera = surface_.T_body_camera()[body];
    const Eigen::Vector3d p = camera_.back_project(u, v, depth);
    const Eigen::Vector3d coarse = across_ray(p, camera_, coarse_in_image);
    const double aside = depth / camera_.fx + kVoxelsAside * field.voxel();
    const Eigen::Vector3d ray = (p + aside * coarse).normalized();
    const Ray ray_body{T_body_camera.translation(), T_body_camera.linear() * ray};
    const Touch touch =
        slide_back(field, touch_nearest(field, T_body_camera * (p + aside * coarse), ray_body),
                   ray_body.direction);
    const Eigen::Vector3d across_body =
        touch.normal - ray_body.direction.dot(touch.normal) * ray_body.direction;
    const Eigen::Vector3d across = T_body_camera.linear().transpose() * across_body;
    const Eigen::Vector3d outline = T_body_camera.inverse() * touch.p;
    if ((camera_.project(outline) - Eigen::Vector2d(u, v)).norm() > kPixelsOff ||
        across.dot(coarse) < kLeastAgreement || !stands_out(outline, across)) {
      return std::nullopt;
    }
    return OutlinePoint{touch.p,
                        across_body.normalized(),
                        plane.slopes().dot(across.head<2>().normalized()) * camera_.fx / depth,
                        plane.steepness() / surface_.reduction(),
                        std::max(0.0, outline.z() - depth),
                        static_cast<double>(surface_.reduction()),
                        static_cast<int>(body)};
  }

 private:
  /// Of the camera, in the body's frame; the direction is a unit vector.
  struct Ray {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;
  };
  /// A point of a body's surface and the outward normal there, in the body's frame.
  struct Touch {
    Eigen::Vector3d p;
    Eigen::Vector3d normal;
  };

  /// Depths that differ by less may be noise, metres.
  double zone(double depth) const {
    return options_.free_space_dead_zone * options_.noise.sigma_z(depth);
  }

  bool ends_beside(const TangentPlane& plane, int u, int v, double jump) const {
    constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const auto depth = static_cast<double>(view_.depth[view_.index(u, v)]);
    return std::any_of(kBeside.begin(), kBeside.end(), [&](const auto& d) {
      const auto there = static_cast<double>(view_.depth[view_.index(u + d[0], v + d[1])]);
      return there > depth * (plane.relative_depth(d[0], d[1]) + jump);
    });
  }

  /// Where a body comes nearest to p, and how far that is.
  static std::pair<Touch, double> nearest(const SignedDistanceField& field,
                                          const Eigen::Vector3d& p) {
    const DistanceSample at = field.sample(p.cast<float>());
    const Eigen::Vector3d normal = at.gradient.cast<double>().normalized();
    const auto distance = static_cast<double>(at.distance);
    return {{p - distance * normal, normal}, distance};
  }

  /// Where a body comes nearest to a ray that passes beside it, by alternating projections.
  static Touch touch_nearest(const SignedDistanceField& field, Eigen::Vector3d beside,
                             const Ray& ray) {
    Touch touch;
    for (int k = 0; k < kProjections; ++k) {
      touch = nearest(field, beside).first;
      beside = ray.origin + ray.direction.dot(touch.p - ray.origin) * ray.direction;
    }
    return touch;
  }

  /// On along a side that is turned to the camera, to where it ends.
  static Touch slide_back(const SignedDistanceField& field, Touch touch,
                          const Eigen::Vector3d& direction) {
    for (int k = 0; k < kMostSteps; ++k) {
      const auto [behind, distance] = nearest(field, touch.p + kStep * direction);
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
    if (u < 0 || v < 0 || u >= view_.width || v >= view_.height) {
      return false;
    }
    return static_cast<double>(view_.depth[view_.index(u, v)]) > p.z() + zone(p.z());
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
  executor.for_each(bands_.size(), [&](std::size_t i) {
    Band& band = bands_[i];
    band.points.clear();
    const int first = static_cast<int>(i) * kRowsInBand;
    for (int v = std::max(first, 1); v < std::min(first + kRowsInBand, view.height - 1); ++v) {
      mark_jumps(view, v, options, band.is_at_jump);
      for (std::size_t u = 0; u < band.is_at_jump.size(); ++u) {
        if (band.is_at_jump[u] == 0) continue;
        if (const auto point = finder.find(static_cast<int>(u), v)) band.points.push_back(*point);
      }
    }
  });
}

}  // namespace lockbox
