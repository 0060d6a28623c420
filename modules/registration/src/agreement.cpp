// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/agreement.hpp"

#include <cmath>

namespace lockbox {
namespace {

constexpr std::size_t kStride = 4;  // of the visible samples; a share needs no more

/// Adds one sample to what it says of its body; nothing if it lies outside the image.
void count(const ArticulatedModel& model, const VisibleSample& sample,
           const Eigen::Isometry3d& T_camera_body, const TiledCloud& cloud,
           const RegistrationOptions& options, Agreement& counts) {
  const Eigen::Vector3d p = T_camera_body * sample.p_body.cast<double>();
  if (p.z() <= 0.0) {
    return;
  }
  const PinholeCamera& camera = cloud.camera();
  const Eigen::Vector2d image = camera.project(p);
  const auto u = std::lround(image.x());
  const auto v = std::lround(image.y());
  if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) {
    return;
  }
  ++counts.samples;
  const auto measured = static_cast<double>(
      cloud.depth()[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
                    static_cast<std::size_t>(u)]);
  if (measured <= 0.0) {
    ++counts.unknown;
    return;
  }
  const double sigma = options.noise.depth_floor + options.noise.depth_quadratic * p.z() * p.z();
  const Eigen::Vector3d q =
      camera.back_project(static_cast<double>(u), static_cast<double>(v), measured);
  const double distance =
      static_cast<double>(model.fields[static_cast<std::size_t>(sample.body)]
                              ->sample((T_camera_body.inverse() * q).cast<float>())
                              .distance);
  if (std::abs(distance) < options.cut * sigma) {
    ++counts.explained;
  } else {
    ++(measured > p.z() ? counts.contradicted : counts.occluded);
  }
}

void add(const Agreement& counts, Agreement& sum) {
  sum.explained += counts.explained;
  sum.contradicted += counts.contradicted;
  sum.occluded += counts.occluded;
  sum.unknown += counts.unknown;
  sum.samples += counts.samples;
}

void make_shares(Agreement& counts) {
  if (counts.samples == 0) {
    return;
  }
  for (double* share :
       {&counts.explained, &counts.contradicted, &counts.occluded, &counts.unknown}) {
    *share /= counts.samples;
  }
}

}  // namespace

void AgreementMeter::measure(const ArticulatedModel& model, const VisibleSurface& surface,
                             const BodyPoses& T_camera_body, const TiledCloud& cloud,
                             const RegistrationOptions& options) {
  total_ = {};
  bodies_.assign(T_camera_body.size(), {});
  if (!cloud.has_image()) {
    return;
  }
  const auto& samples = surface.samples();
  for (std::size_t i = 0; i < samples.size(); i += kStride) {
    const auto body = static_cast<std::size_t>(samples[i].body);
    count(model, samples[i], T_camera_body[body], cloud, options, bodies_[body]);
  }
  for (Agreement& body : bodies_) {
    add(body, total_);
    make_shares(body);
  }
  make_shares(total_);
}

}  // namespace lockbox
