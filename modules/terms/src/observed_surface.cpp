// SPDX-License-Identifier: BSD-3-Clause
#include "observed_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

/// Distances in pixels at which the neighbourhood is probed: dense near the sample, where contours
/// are decided, sparse far from it, where a direction is all that is needed.
constexpr std::array<int, 14> kProbeRadii{1, 2, 3, 4, 5, 6, 7, 8, 11, 15, 20, 27, 36, 48};
constexpr std::array<std::array<int, 2>, 8> kProbeDirections{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

}  // namespace

bool ObservedSurface::sees_through(const Pixel& pixel, double expected, double steepness) const {
  const double behind = measured(pixel) - expected;
  const double lateral = options_.noise.lateral_pixels * steepness * expected;
  const double zone = options_.free_space_tolerance;
  const double sigma = sigma_z(expected);
  return behind > 0.0 && behind * behind > zone * zone * (sigma * sigma + lateral * lateral);
}

int ObservedSurface::drawn_body(const Pixel& pixel) const {
  const RenderedDepth& view = surface_.view();
  // What a reduced view cuts off at the right and below is as its last column and row.
  const int u = std::min(pixel.u / surface_.reduction(), view.width - 1);
  const int v = std::min(pixel.v / surface_.reduction(), view.height - 1);
  return view.id[view.index(u, v)];
}

bool ObservedSurface::belongs_to(int body, const Eigen::Vector3d& p_camera) const {
  const auto b = static_cast<std::size_t>(body);
  const DistanceSample at = model_.fields[b]->sample((T_body_camera_[b] * p_camera).cast<float>());
  const auto distance = static_cast<double>(at.distance);
  const double sigma = sigma_z(p_camera.z());
  return distance * distance <
         options_.gate * options_.gate * (sigma * sigma + annealing_sigma_ * annealing_sigma_);
}

bool ObservedSurface::shows_object(const Pixel& pixel, int body) const {
  const double depth = measured(pixel);
  if (depth <= 0.0) {
    return false;
  }
  const Eigen::Vector3d p = cloud_.camera().back_project(pixel.u, pixel.v, depth);
  const int drawn = drawn_body(pixel);
  return belongs_to(body, p) || (drawn != kNothing && drawn != body && belongs_to(drawn, p));
}

std::optional<Eigen::Vector3d> ObservedSurface::nearest(const Eigen::Vector3d& p_camera,
                                                        const Pixel& pixel, int body,
                                                        double farthest) const {
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d best;
  const double inverse_lateral2 = 1.0 / std::pow(sigma_lateral(p_camera.z()), 2);
  const double inverse_depth2 = 1.0 / std::pow(sigma_z(p_camera.z()), 2);
  const double pixel_size = p_camera.z() / cloud_.camera().fx;
  const Eigen::Vector3d ray = p_camera / p_camera.z();
  const double slant = ray.norm();
  const auto probe = [&](int pu, int pv) {
    if (!inside(pu, pv)) {
      return;
    }
    const double depth = measured({pu, pv});
    const Eigen::Vector3d q = cloud_.camera().back_project(pu, pv, depth);
    if (!((q - p_camera).squaredNorm() < farthest * farthest)) return;
    const double along = q.z() - p_camera.z();
    const double across2 = (q - p_camera - along * ray).squaredNorm();
    const double distance2 = along * along * inverse_depth2 + across2 * inverse_lateral2;
    if (depth > 0.0 && distance2 < least && shows_object({pu, pv}, body)) {
      least = distance2;
      best = q;
    }
  };
  probe(pixel.u, pixel.v);
  for (const int radius : kProbeRadii) {
    // Whatever lies farther out in the image is farther away.
    if (radius * pixel_size > slant * farthest) break;
    if (std::pow(radius * pixel_size, 2) * inverse_lateral2 > least) break;
    for (const auto& direction : kProbeDirections) {
      probe(pixel.u + radius * direction[0], pixel.v + radius * direction[1]);
    }
  }
  return std::isfinite(least) ? std::optional(best) : std::nullopt;
}

}  // namespace lockbox
