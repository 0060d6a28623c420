// SPDX-License-Identifier: BSD-3-Clause
#include "size_meter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

using Index = Eigen::Index;

/// Of sizes, if the image says nothing: standard deviation. Doubled, nothing changes where the
/// image does.
constexpr double kAnySize = 0.1;
/// How far contours are sought, as a share of the object's extent: what is off in size by as much
/// is still found. Doubled, more of what is around the object is mistaken for its contour.
constexpr double kSought = 0.12;
/// The same, of what they are sought in the rounds that follow.
constexpr std::array kRounds = {1.0, 0.5, 0.25, 0.1, 0.1};
/// Faces are near where the descent has left them, whatever the size: their share of that.
constexpr double kFacesSought = 0.25;
/// Metres that a point of a built object is off, and a whole face or edge; pixels that a sensor
/// sees a whole edge aside. Doubled, standard deviations are up to twice as large.
constexpr double kPointOff = 0.002;
constexpr double kSideOff = 0.0005;
constexpr double kSidePixels = 0.25;
/// Of what a contour is sought, from which on it was rather not found.
constexpr double kSurelySeen = 0.74;
constexpr double kHeld = 1e12;  // 1 / variance of what does not move
/// Points of faces that are measured, about, at most. Source: not recorded. Doubled, a measurement
/// takes longer, and hardly tells more: neighbours err alike.
constexpr std::size_t kMostFacePoints = 3000;
/// Of the length of a field's gradient from 1: near edges it is shorter.
constexpr double kFlat = 0.03;

/// Returns the share of inliers of a residual with this variance: 1 where it is small, 0 for
/// outliers beyond the gate.
double inlier_share(double residual, double variance, double gate) {
  const double gaussian = std::exp(-0.5 * residual * residual / variance);
  return gaussian / (gaussian + std::exp(-0.5 * gate * gate));
}

}  // namespace

SizeMeter::SizeMeter(const ArticulatedModel& model, const RegistrationOptions& options,
                     const Steps& steps)
    : model_(model), options_(options), steps_(steps) {}

SizeMeasurement SizeMeter::measure(const PredictedView& view, const TiledCloud& cloud,
                                   const Configuration& configuration) {
  forward_kinematics(model_.tree, configuration, poses_);
  body_jacobians(model_.tree, poses_, jacobians_);
  base_ = configuration.T_camera_base.translation();
  side_off_ = std::hypot(kSideOff, kSidePixels * base_.norm() / cloud.camera().fx);
  step_.setZero(steps_.scale().unit.size() + kSizeUnknowns);
  choose_faces(view);
  for (const double round : kRounds) {
    const double annealing_sigma = round * kSought * extent_ / options_.gate;
    add_contours(view, cloud, annealing_sigma);
    add_faces(cloud, kFacesSought * annealing_sigma);
    take_step();
  }
  const Index size = step_.size() - kSizeUnknowns;
  const Eigen::MatrixXd covariance =
      factors_.solve(Eigen::MatrixXd::Identity(step_.size(), step_.size()));
  return {Eigen::Vector2d::Ones() + step_.segment<2>(size), covariance.block<2, 2>(size, size),
          effect()};
}

/// Where the size is held, at the least cost the others go by -H_xx^-1 H_xs for each unit of it.
Eigen::Matrix<double, Eigen::Dynamic, 2> SizeMeter::effect() {
  const Index size = step_.size() - kSizeUnknowns;
  Eigen::Matrix<double, Eigen::Dynamic, 2> of_size = hessian_.middleCols<2>(size);
  of_size.middleRows<2>(size).setZero();
  hessian_.middleCols<2>(size).setZero();
  hessian_.middleRows<2>(size).setZero();
  hessian_.block<2, 2>(size, size).setIdentity();
  factors_.compute(hessian_);
  return factors_.solve(of_size).topRows(size);
}

/// Chooses points of the surface that is visible, where it is flat.
void SizeMeter::choose_faces(const PredictedView& view) {
  face_points_.clear();
  Eigen::AlignedBox3d bounds;
  std::size_t count = 0;
  for (const ViewSamples::Chunk& chunk : view.samples().chunks()) count += chunk.count;
  const std::size_t stride = count / kMostFacePoints + 1;
  for (const ViewSamples::Chunk& chunk : view.samples().chunks()) {
    const auto b = static_cast<std::size_t>(chunk.body);
    for (std::size_t i = chunk.first; i < chunk.first + chunk.count; i += stride) {
      const Eigen::Vector3f point = view.samples().sample(chunk.body, i).p_body;
      const Eigen::Vector3d gradient = model_.fields[b]->sample(point).gradient.cast<double>();
      if (std::abs(gradient.norm() - 1.0) > kFlat) continue;
      face_points_.push_back({chunk.body, point.cast<double>(), gradient.normalized()});
      bounds.extend(poses_[b] * face_points_.back().point);
    }
  }
  extent_ = bounds.isEmpty() ? 0.0 : bounds.sizes().head<2>().maxCoeff();
}

/// How the step moves a point of a body, body frame.
Eigen::Vector3d SizeMeter::motion(int body, const Eigen::Vector3d& point) const {
  const Index size = step_.size() - kSizeUnknowns;
  const auto b = static_cast<std::size_t>(body);
  const Eigen::Isometry3d& T = poses_[b];
  const Twist twist = jacobians_[b] * step_.head(size);
  const Eigen::Vector3d grown = size_motion(base_, T * point, step_[size], step_[size + 1]);
  return twist.head<3>() + twist.tail<3>().cross(point) + T.linear().transpose() * grown;
}

/// Each is compared where it would be seen by now: where it was, another face may be measured.
void SizeMeter::add_faces(const TiledCloud& cloud, double annealing_sigma) {
  faces_.set_zero(poses_.size());
  const PinholeCamera& camera = cloud.camera();
  const SensorNoise& noise = options_.noise;
  for (const FacePoint& face : face_points_) {
    const Eigen::Isometry3d& T = poses_[static_cast<std::size_t>(face.body)];
    const Eigen::Vector3d q = T * (face.point + motion(face.body, face.point));
    const auto pixel = camera.pixel_of(q);
    if (!pixel) continue;
    const auto z = static_cast<double>(
        cloud.depth()[static_cast<std::size_t>(pixel->v * camera.width + pixel->u)]);
    const Eigen::Vector3d ray = camera.back_project(pixel->u, pixel->v, 1.0);
    const Eigen::Vector3d n = T.linear() * face.normal;
    const double along = n.dot(ray);
    if (!(z > 0.0) || !(along < 0.0)) continue;
    const double across2 = std::max(0.0, 1.0 - along * along / ray.squaredNorm());
    const double residual = n.dot(z * ray - q);
    const double variance = std::pow(along * noise.sigma_z(z), 2) +
                            across2 * std::pow(noise.sigma_lateral(z, camera.fx), 2) +
                            kPointOff * kPointOff + annealing_sigma * annealing_sigma;
    faces_.add({face.body, false, face.normal, face.normal.dot(face.point)},
               size_row(T, base_, q, -n, 0.0), residual, weight(residual, variance));
  }
}

void SizeMeter::add_contours(const PredictedView& view, const TiledCloud& cloud,
                             double annealing_sigma) {
  contours_.set_zero(poses_.size());
  for (std::size_t i = 0; i < view.contours().bands(); ++i) {
    for (std::span<const ContourPoint> rest(view.contours().band(i)); !rest.empty();) {
      const int body = rest.front().body;
      const auto end = std::find_if(rest.begin(), rest.end(),
                                    [body](const ContourPoint& p) { return p.body != body; });
      const auto own = rest.first(static_cast<std::size_t>(end - rest.begin()));
      rest = rest.subspan(own.size());
      add_contours_of_body(own, cloud, annealing_sigma);
    }
  }
}

void SizeMeter::add_contours_of_body(std::span<const ContourPoint> own, const TiledCloud& cloud,
                                     double annealing_sigma) {
  moved_.assign(own.begin(), own.end());
  for (ContourPoint& point : moved_) point.p_body += motion(point.body, point.p_body);
  const Eigen::Isometry3d& T = poses_[static_cast<std::size_t>(own.front().body)];
  observed_.look(moved_, T, cloud, options_, annealing_sigma);
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (!observed_.is_seen(k)) continue;
    const Eigen::Vector3d point = T * moved_[k].p_body;
    const double pixel = point.z() / cloud.camera().fx;
    const double sought =
        options_.gate * std::hypot(options_.noise.lateral_pixels * pixel, annealing_sigma);
    if (std::abs(observed_.offset_of(k)) > kSurelySeen * sought) continue;
    const double growth = step_[step_.size() - 1];
    const double residual = pixel * growth - observed_.offset_of(k);
    const double variance =
        observed_.variance_of(k) + kPointOff * kPointOff + annealing_sigma * annealing_sigma;
    const ContourPoint& contour = own[k];
    contours_.add(
        {contour.body, true, contour.normal_body, contour.normal_body.dot(contour.p_body)},
        size_row(T, base_, point, T.linear() * contour.normal_body, pixel), residual,
        contour.pixels * weight(residual, variance));
  }
}

double SizeMeter::weight(double residual, double variance) const {
  return inlier_share(residual, variance, options_.gate) /
         (variance * options_.contour_correlation);
}

/// What nothing is known of stays where it is.
void SizeMeter::take_step() {
  const Index size = step_.size() - kSizeUnknowns;
  Eigen::VectorXd prior(step_.size());
  for (Index i = 0; i < size; ++i) {
    const bool is_held = steps_.held()[static_cast<std::size_t>(i)];
    prior[i] = is_held ? kHeld : 1.0 / std::pow(steps_.scale().unit[i], 2);
  }
  prior[size] = prior[size + 1] = 1.0 / (kAnySize * kAnySize);
  prior[size + 2] = 1.0 / std::pow(options_.noise.lateral_pixels, 2);
  hessian_ = prior.asDiagonal();
  gradient_ = prior.cwiseProduct(step_);
  faces_.add_to(jacobians_, side_off_, hessian_, gradient_);
  contours_.add_to(jacobians_, side_off_, hessian_, gradient_);
  factors_.compute(hessian_);
  step_ -= factors_.solve(gradient_);
}

}  // namespace lockbox
