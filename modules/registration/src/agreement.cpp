// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/agreement.hpp"

#include <array>
#include <cmath>

#include "outline.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kStride = 4;  // of the visible samples; a share needs no more
constexpr std::size_t kSamplesPerChunk = 4096;
constexpr int kBeyond = 3;  // pixels of the view, across an outline

std::size_t index(int width, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(u);
}

double sigma_z(const RegistrationOptions& options, double z) {
  return options.noise.depth_floor + options.noise.depth_quadratic * z * z;
}

/// Adds one sample to what it says of its body; nothing if it lies outside the image.
void count(const ArticulatedModel& model, const VisibleSample& sample,
           const Eigen::Isometry3d& T_camera_body, const TiledCloud& cloud,
           const RegistrationOptions& options, Agreement& counts) {
  const Eigen::Vector3d p = T_camera_body * sample.p_body.cast<double>();
  const PinholeCamera& camera = cloud.camera();
  const auto pixel = camera.pixel_of(p);
  if (!pixel) {
    return;
  }
  ++counts.samples;
  const auto measured = static_cast<double>(cloud.depth()[index(camera.width, pixel->u, pixel->v)]);
  if (measured <= 0.0) {
    ++counts.unknown;
    return;
  }
  const Eigen::Vector3d q = camera.back_project(pixel->u, pixel->v, measured);
  const double distance =
      static_cast<double>(model.fields[static_cast<std::size_t>(sample.body)]
                              ->sample((T_camera_body.inverse() * q).cast<float>())
                              .distance);
  if (std::abs(distance) < options.cut * sigma_z(options, p.z())) {
    ++counts.explained;
  } else {
    ++(measured > p.z() ? counts.contradicted : counts.occluded);
  }
}

/// Looks across the outline, if the sample lies at one: left, right, up and down.
void look_beyond(const VisibleSurface& surface, const VisibleSample& sample,
                 const TiledCloud& cloud, const RegistrationOptions& options,
                 OutlineAgreement& outline) {
  const RenderedDepth& view = surface.view();
  constexpr std::array<std::array<int, 2>, 4> kWays{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (const auto& [du, dv] : kWays) {
    const int u = sample.u + kBeyond * du;
    const int v = sample.v + kBeyond * dv;
    if (u < 0 || v < 0 || u >= view.width || v >= view.height ||
        view.id[index(view.width, u, v)] != kNothing) {
      continue;
    }
    const double measured = static_cast<double>(cloud.depth()[index(
        cloud.camera().width, u * surface.reduction(), v * surface.reduction())]);
    const TangentPlane plane(view, sample.u, sample.v);
    const double expected = static_cast<double>(view.depth[index(view.width, sample.u, sample.v)]) *
                            plane.relative_depth(kBeyond * du, kBeyond * dv);
    const double gate = options.cut * sigma_z(options, expected);
    const bool is_measured = measured > 0.0;
    if (is_measured && measured < expected - gate) {
      continue;
    }
    ++outline.samples;
    outline.goes_on += is_measured && measured < expected + gate ? 1 : 0;
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
                             const RegistrationOptions& options, const Executor& executor) {
  const std::size_t bodies = T_camera_body.size();
  total_ = {};
  bodies_.assign(bodies, {});
  outline_ = {};
  if (!cloud.has_image()) {
    return;
  }
  const auto& samples = surface.samples();
  const std::size_t chunks = chunk_count(samples.size(), kSamplesPerChunk);
  chunk_bodies_.assign(chunks * bodies, {});
  chunk_outlines_.assign(chunks, {});
  executor.for_each_chunk(
      samples.size(), kSamplesPerChunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; i += kStride) {
          const auto body = static_cast<std::size_t>(samples[i].body);
          count(model, samples[i], T_camera_body[body], cloud, options,
                chunk_bodies_[chunk * bodies + body]);
          look_beyond(surface, samples[i], cloud, options, chunk_outlines_[chunk]);
        }
      });
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    for (std::size_t b = 0; b < bodies; ++b) {
      add(chunk_bodies_[chunk * bodies + b], bodies_[b]);
    }
    outline_.samples += chunk_outlines_[chunk].samples;
    outline_.goes_on += chunk_outlines_[chunk].goes_on;
  }
  for (Agreement& body : bodies_) {
    add(body, total_);
    make_shares(body);
  }
  make_shares(total_);
}

}  // namespace lockbox
