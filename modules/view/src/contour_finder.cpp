// SPDX-License-Identifier: BSD-3-Clause
#include "contour_finder.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

constexpr float kPixelsBeyond = 1.5F;    // a contour: where something farther away is to be seen
constexpr float kFarthestOff = 2.0F;     // farther from the pixel it is another contour
constexpr float kLeastAgreement = 0.5F;  // of the field's normal with the z-buffer's: a cosine

}  // namespace

ContourFinder::ContourFinder(const VisibleSurface& surface, const ViewEdges& edges,
                             const ContinuedEdges& continued, int spacing,
                             const ViewOptions& options)
    : surface_(surface),
      view_(surface.view()),
      edges_(edges),
      continued_(continued),
      camera_(surface.view_camera()),
      options_(options),
      points_per_pixel_(std::max(1, surface.reduction() / spacing)) {}

void ContourFinder::append_jumps(int v, std::vector<Pixel>& pixels) const {
  const int first = std::max(view_.drawn.left, 1);
  const int end = std::min(view_.drawn.right(), view_.width - 1);
  const float* const z = view_.depth.data() + view_.index(0, v);
  const auto tolerance = static_cast<float>(options_.free_space_tolerance);
  const float floor = tolerance * static_cast<float>(options_.noise.depth_floor);
  const float linear = tolerance * static_cast<float>(options_.noise.depth_linear);
  const float quadratic = tolerance * static_cast<float>(options_.noise.depth_quadratic);
  for (const int u : edges_.row(v)) {
    if (u < first || u >= end || continued_.covers(view_.index(u, v))) continue;
    const float beside =
        std::max(std::max(z[u - 1], z[u + 1]), std::max(z[u - view_.width], z[u + view_.width]));
    if (beside > z[u] + (quadratic * (z[u] * z[u]) + (linear * z[u] + floor)))
      pixels.push_back({u, v});
  }
}

std::optional<ContourPixel> ContourFinder::look_beside(int u, int v) const {
  const double here = depth(u, v);
  const double jump = std::max(here / camera_.fx, zone(here)) / here;
  const TangentPlane plane(view_, u, v);
  if (!ends_beside(plane, u, v, jump)) {
    return std::nullopt;
  }
  const Eigen::Vector2d in_image = contour_normal(view_, plane, u, v, jump);
  if (in_image.isZero()) {
    return std::nullopt;
  }
  return ContourPixel{{u, v}, static_cast<float>(here), plane, in_image.cast<float>()};
}

void ContourFinder::fill_in(const ContourPoint& point, std::vector<ContourPoint>& points) const {
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

std::optional<ContourPoint> ContourFinder::point(const ContourPixel& pixel,
                                                 const ContourTouch& touch) const {
  const Eigen::Vector2f off =
      touch.at - Eigen::Vector2f(static_cast<float>(pixel.at.u), static_cast<float>(pixel.at.v));
  if (!(off.squaredNorm() <= kFarthestOff * kFarthestOff) || touch.agreement < kLeastAgreement ||
      !stands_out(touch)) {
    return std::nullopt;
  }
  const auto here = static_cast<double>(pixel.depth);
  return ContourPoint{touch.p_body.cast<double>(),
                      touch.normal_body.cast<double>(),
                      pixel.plane.slopes().dot(touch.direction.cast<double>()) * camera_.fx / here,
                      pixel.plane.steepness() / surface_.reduction(),
                      std::max(0.0, static_cast<double>(touch.depth) - here),
                      static_cast<double>(surface_.reduction()) / points_per_pixel_,
                      body(pixel.at.u, pixel.at.v)};
}

/// Depths that differ by less may be noise, metres.
double ContourFinder::zone(double depth) const {
  return options_.free_space_tolerance * options_.noise.sigma_z(depth);
}

bool ContourFinder::ends_beside(const TangentPlane& plane, int u, int v, double jump) const {
  // (du, dv) to the four sides.
  constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const double here = depth(u, v);
  return std::any_of(kBeside.begin(), kBeside.end(), [&](const auto& d) {
    const double nearness = plane.relative_nearness(d[0], d[1]);
    return depth(u + d[0], v + d[1]) * nearness > here * (1.0 + jump * nearness);
  });
}

/// Whether what the view shows just beyond the contour lies behind it by more than noise.
bool ContourFinder::stands_out(const ContourTouch& touch) const {
  const Eigen::Vector2f beyond =
      touch.at + kPixelsBeyond * touch.direction + Eigen::Vector2f(0.5F, 0.5F);
  const int u = static_cast<int>(beyond.x());
  const int v = static_cast<int>(beyond.y());
  if (u < 0 || v < 0 || u >= view_.width || v >= view_.height) {
    return false;
  }
  const auto here = static_cast<double>(touch.depth);
  return depth(u, v) > here + zone(here);
}

}  // namespace lockbox
