// SPDX-License-Identifier: BSD-3-Clause
#include "outline_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

/// How far beside an outline the field is asked. At a distance d from an edge tri-linear distances
/// are too large by up to voxel^2 / (8 d), but fine samples reach 20 mm only.
constexpr double kVoxelsAside = 4.0;
constexpr double kFarthestAside = 0.016;  // metres
constexpr double kPixelsBeyond = 1.5;     // an outline: where something farther away is to be seen
constexpr double kFarthestOff = 2.0;      // farther from the pixel it is another outline
constexpr double kLeastAgreement = 0.5;   // of the field's normal with the z-buffer's: a cosine

/// The part of a vector that is orthogonal to a ray.
Eigen::Vector3d across(const Eigen::Vector3d& ray, const Eigen::Vector3d& vector) {
  return vector - ray.dot(vector) / ray.squaredNorm() * ray;
}

/// Unit vector in the camera's frame that moves a point at p along a direction of the image, across
/// its ray.
Eigen::Vector3d across_ray(const Eigen::Vector3d& p, const PinholeCamera& camera,
                           const Eigen::Vector2d& direction) {
  const Eigen::Vector3d along_image(direction.x() / camera.fx, direction.y() / camera.fy, 0.0);
  return across(p, along_image).normalized();
}

}  // namespace

OutlineFinder::OutlineFinder(const ArticulatedModel& model, const VisibleSurface& surface,
                             const ViewEdges& edges, int spacing,
                             const RegistrationOptions& options)
    : model_(model),
      surface_(surface),
      view_(surface.view()),
      edges_(edges),
      camera_(surface.view_camera()),
      options_(options),
      points_per_pixel_(std::max(1, surface.reduction() / spacing)) {}

void OutlineFinder::append_jumps(int v, std::vector<Pixel>& pixels) const {
  const int first = std::max(view_.drawn.left, 1);
  const int end = std::min(view_.drawn.right(), view_.width - 1);
  const float* const z = view_.depth.data() + view_.index(0, v);
  const auto dead_zone = static_cast<float>(options_.free_space_dead_zone);
  const float floor = dead_zone * static_cast<float>(options_.noise.depth_floor);
  const float quadratic = dead_zone * static_cast<float>(options_.noise.depth_quadratic);
  for (const int u : edges_.row(v)) {
    if (u < first || u >= end) continue;
    const float beside =
        std::max(std::max(z[u - 1], z[u + 1]), std::max(z[u - view_.width], z[u + view_.width]));
    if (beside > z[u] + (quadratic * (z[u] * z[u]) + floor)) pixels.push_back({u, v});
  }
}

std::optional<OutlinePixel> OutlineFinder::look_beside(int u, int v) const {
  const double here = depth(u, v);
  const double jump = std::max(here / camera_.fx, zone(here)) / here;
  const TangentPlane plane(view_, u, v);
  if (!ends_beside(plane, u, v, jump)) {
    return std::nullopt;
  }
  const Eigen::Vector2d in_image = outline_normal(view_, plane, u, v, jump);
  if (in_image.isZero()) {
    return std::nullopt;
  }
  const Eigen::Vector3d p = camera_.back_project(u, v, here);
  return OutlinePixel{view_.id[view_.index(u, v)],     u, v, plane, p,
                      across_ray(p, camera_, in_image)};
}

Eigen::Vector3d OutlineFinder::beside(const OutlinePixel& pixel) const {
  const auto body = static_cast<std::size_t>(pixel.body);
  return surface_.T_body_camera()[body] * (pixel.p + aside(pixel) * pixel.outwards);
}

Eigen::Vector3d OutlineFinder::beside(const OutlinePixel& pixel,
                                      const Eigen::Vector3d& normal) const {
  const auto body = static_cast<std::size_t>(pixel.body);
  const Eigen::Isometry3d& T_body_camera = surface_.T_body_camera()[body];
  const Eigen::Vector3d p = T_body_camera * pixel.p;
  return p + aside(pixel) * across(p - T_body_camera.translation(), normal).normalized();
}

void OutlineFinder::spread(const OutlinePoint& point, std::vector<OutlinePoint>& points) const {
  const Eigen::Isometry3d& T_body_camera =
      surface_.T_body_camera()[static_cast<std::size_t>(point.body)];
  const Eigen::Vector3d ray = point.p_body - T_body_camera.translation();
  const Eigen::Vector3d pixel_along =
      point.normal_body.cross(ray) / (camera_.fx);  // about a pixel of the view, for ray ~ depth
  for (int k = 0; k < points_per_pixel_; ++k) {
    const double pixels_off = (k + 0.5) / points_per_pixel_ - 0.5;
    points.push_back(point);
    points.back().p_body += pixels_off * pixel_along;
  }
}

double OutlineFinder::aside(const OutlinePixel& pixel) const {
  const double pixel_size = pixel.p.z() / camera_.fx;
  const double voxel = model_.fields[static_cast<std::size_t>(pixel.body)]->voxel();
  return pixel_size + std::clamp(kFarthestAside - pixel_size, voxel, kVoxelsAside * voxel);
}

std::optional<OutlinePoint> OutlineFinder::point(const OutlinePixel& pixel,
                                                 const Eigen::Vector3d& touch,
                                                 const Eigen::Vector3d& normal) const {
  const Eigen::Isometry3d& T_body_camera =
      surface_.T_body_camera()[static_cast<std::size_t>(pixel.body)];
  const Eigen::Vector3d from_camera = touch - T_body_camera.translation();
  const Eigen::Vector3d across_body = across(from_camera, normal);
  const Eigen::Vector3d outwards = T_body_camera.linear().transpose() * across_body;
  const Eigen::Vector3d outline = T_body_camera.linear().transpose() * from_camera;
  const Eigen::Vector2d off = camera_.project(outline) - Eigen::Vector2d(pixel.u, pixel.v);
  if (off.norm() > kFarthestOff || outwards.dot(pixel.outwards) < kLeastAgreement ||
      !stands_out(outline, outwards)) {
    return std::nullopt;
  }
  const double here = pixel.p.z();
  return OutlinePoint{touch,
                      across_body.normalized(),
                      pixel.plane.slopes().dot(outwards.head<2>().normalized()) * camera_.fx / here,
                      pixel.plane.steepness() / surface_.reduction(),
                      std::max(0.0, outline.z() - here),
                      static_cast<double>(surface_.reduction()) / points_per_pixel_,
                      pixel.body};
}

/// Depths that differ by less may be noise, metres.
double OutlineFinder::zone(double depth) const {
  return options_.free_space_dead_zone * options_.noise.sigma_z(depth);
}

bool OutlineFinder::ends_beside(const TangentPlane& plane, int u, int v, double jump) const {
  constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const double here = depth(u, v);
  return std::any_of(kBeside.begin(), kBeside.end(), [&](const auto& d) {
    return depth(u + d[0], v + d[1]) > here * (plane.relative_depth(d[0], d[1]) + jump);
  });
}

/// Whether what the view shows just beyond the outline lies behind it by more than noise.
bool OutlineFinder::stands_out(const Eigen::Vector3d& p, const Eigen::Vector3d& outwards) const {
  const Eigen::Vector2d beyond = camera_.project(p) +
                                 kPixelsBeyond * outwards.head<2>().normalized() +
                                 Eigen::Vector2d(0.5, 0.5);
  const int u = static_cast<int>(beyond.x());
  const int v = static_cast<int>(beyond.y());
  if (u < 0 || v < 0 || u >= view_.width || v >= view_.height) {
    return false;
  }
  return depth(u, v) > p.z() + zone(p.z());
}

}  // namespace lockbox
