// SPDX-License-Identifier: BSD-3-Clause
#include "correspondence_finder.hpp"

#include <algorithm>
#include <cmath>

#include "image_tile.hpp"

namespace lockbox {
namespace {

constexpr double kLeastWeight = 1e-3;  // below it a sample is not worth keeping

/// Returns the share in the mixture of kernels::associate for a single body: 1 for small residuals,
/// 0 for outliers, whose density beside the largest of a residual is given.
double gaussian_share(double residual, double inverse_variance, double outliers) {
  const double gaussian = std::exp(-0.5 * residual * residual * inverse_variance);
  return gaussian / (gaussian + outliers);
}

double density_of_outliers(double gate) {
  return std::exp(-0.5 * gate * gate);
}

constexpr double kAnyDirection = 1.0 / 3.0;  // of a random unit vector's square, along each axis

}  // namespace

CorrespondenceFinder::CorrespondenceFinder(const FreeSpaceTerm::Scene& scene,
                                           const BodyPoses& T_body_camera, double annealing_sigma)
    : surface_(scene.surface),
      continued_(scene.continued),
      camera_(scene.cloud.camera()),
      observed_(scene.model, scene.surface, T_body_camera, scene.cloud, scene.options,
                annealing_sigma),
      options_(scene.options),
      outliers_(density_of_outliers(scene.options.gate)),
      annealing_sigma_(annealing_sigma) {}

std::optional<FreeSpaceCorrespondence> CorrespondenceFinder::find(
    const ViewSample& sample, double weight, const Eigen::Isometry3d& T_camera_body) const {
  const Eigen::Vector3d p = T_camera_body * sample.p_body.cast<double>();
  const auto pixel = camera_.pixel_of(p);
  if (!pixel || !observed_.sees_through(*pixel, p.z(), 0.0)) {
    return std::nullopt;
  }
  const TangentPlane plane(surface_.view(), sample.pixel.u, sample.pixel.v);
  if (!observed_.sees_through(*pixel, p.z(), plane.steepness() / surface_.reduction())) {
    return std::nullopt;
  }
  if (observed_.shows_object(*pixel, sample.body)) {
    return std::nullopt;  // the tail of the noise: this point has its say in the model term
  }
  if (is_beside_contour(sample, plane) ||
      continued_.covers(surface_.view().index(sample.pixel.u, sample.pixel.v))) {
    return std::nullopt;
  }
  return aim(sample, weight, p, *pixel);
}

/// What is seen beside a contour says where the contour is: that has correspondences of its own.
/// The nearest observed pixel lies in a direction that the grid decides, and would hold the body
/// against sliding along its own contour.
bool CorrespondenceFinder::is_beside_contour(const ViewSample& sample,
                                             const TangentPlane& plane) const {
  return !contour_normal(surface_.view(), plane, sample.pixel.u, sample.pixel.v,
                         static_cast<double>(surface_.reduction()) / camera_.fx)
              .isZero();
}

/// Aims from p at the nearest observed point of the object.
std::optional<FreeSpaceCorrespondence> CorrespondenceFinder::aim(const ViewSample& sample,
                                                                 double weight,
                                                                 const Eigen::Vector3d& p,
                                                                 const Pixel& pixel) const {
  const auto nearest = observed_.nearest(p, pixel, sample.body, farthest(p));
  if (!nearest) {
    return std::nullopt;
  }
  const double way = (p - *nearest).norm();
  // Metres: the point is where it should be, and no direction is told.
  if (way < 1e-9) {
    return std::nullopt;
  }
  const Eigen::Vector3d direction = (p - *nearest) / way;
  const double variance = variance_of(p, direction);
  if (gaussian_share(way, 1.0 / (variance + annealing_sigma_ * annealing_sigma_), outliers_) <=
      kLeastWeight) {
    return std::nullopt;
  }
  // Noise at either end turns a short correspondence.
  const double direction_variance =
      std::clamp(variance / (way * way), kNormalVariance, kAnyDirection);
  return FreeSpaceCorrespondence{sample.p_body,
                                 nearest->cast<float>(),
                                 direction.cast<float>(),
                                 static_cast<float>(variance),
                                 static_cast<float>(direction_variance),
                                 static_cast<float>(sample.pixels * weight),
                                 sample.body,
                                 tile_of(pixel, camera_)};
}

/// Metres from p to what would still weigh more than kLeastWeight.
double CorrespondenceFinder::farthest(const Eigen::Vector3d& p) const {
  const double along = p.norm() / p.z() * observed_.sigma_z(p.z());
  const double across = observed_.sigma_lateral(p.z());
  const double variance = along * along + across * across + annealing_sigma_ * annealing_sigma_;
  return std::sqrt(variance * (options_.gate * options_.gate - 2.0 * std::log(kLeastWeight)));
}

/// Returns the variance of a point at p along a direction, by the sensor's noise.
double CorrespondenceFinder::variance_of(const Eigen::Vector3d& p,
                                         const Eigen::Vector3d& direction) const {
  const double along = direction.dot(p);
  const double across2 = std::max(0.0, 1.0 - along * along / p.squaredNorm());
  return std::pow(along / p.z() * observed_.sigma_z(p.z()), 2) +
         across2 * std::pow(observed_.sigma_lateral(p.z()), 2);
}

}  // namespace lockbox
