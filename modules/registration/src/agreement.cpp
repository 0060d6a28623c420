// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lockbox/registration/rigid_motion.hpp"
#include "outline.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kStride = 4;  // of the visible samples; a share needs no more
constexpr std::size_t kRowsPerChunk = 8;
constexpr int kBeyond = 3;          // pixels of the view, across an outline
constexpr float kRounding = 1e-5F;  // metres: more than single precision errs

std::size_t index(int width, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(u);
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
  if (std::abs(distance) < options.cut * options.noise.sigma_z(p.z())) {
    ++counts.explained;
  } else {
    ++(measured > p.z() ? counts.contradicted : counts.occluded);
  }
}

/// Looks across the outline, if the sample lies at one: left, right, up and down.
void look_beyond(const VisibleSurface& surface, const Pixel& sample, const TiledCloud& cloud,
                 const RegistrationOptions& options, OutlineAgreement& outline) {
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
    const double gate = options.cut * options.noise.sigma_z(expected);
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
  const auto rows = static_cast<std::size_t>(surface.view().height);
  const std::size_t chunks = chunk_count(rows, kRowsPerChunk);
  chunk_bodies_.assign(chunks * bodies, {});
  chunk_outlines_.assign(chunks, {});
  const ReprojectedView reprojected(surface, T_camera_body, cloud, executor, scratch_);
  reserve(executor, bodies, kRowsPerChunk * static_cast<std::size_t>(surface.view().width));
  executor.for_each_chunk(
      rows, kRowsPerChunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        const std::span<Agreement> counts(chunk_bodies_.data() + chunk * bodies, bodies);
        const std::span<MeasuredPoints> points(points_.data() + Executor::worker() * bodies,
                                               bodies);
        for (auto v = static_cast<int>(begin); v < static_cast<int>(end); ++v) {
          look_at_row(model, surface, T_camera_body, cloud, options, reprojected, v, points, counts,
                      chunk_outlines_[chunk]);
        }
        for (std::size_t b = 0; b < bodies; ++b) {
          count_points(model, surface, b, T_camera_body[b], cloud, options, points[b], counts[b]);
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

void AgreementMeter::reserve(const Executor& executor, std::size_t bodies, std::size_t points) {
  const std::size_t workers = static_cast<std::size_t>(executor.threads()) + 1;
  points_.resize(workers * bodies);
  for (MeasuredPoints& of_body : points_) {
    of_body.size = 0;
    of_body.view_pixel.resize(points);
    for (auto* array : {&of_body.x, &of_body.y, &of_body.z, &of_body.expected, &of_body.distance}) {
      array->resize(kernels::padded(points));
    }
  }
}

/// Counts what needs no field, and collects the measured points of which a field has to tell how
/// far they lie from the body.
void AgreementMeter::look_at_row(const ArticulatedModel& model, const VisibleSurface& surface,
                                 const BodyPoses& T_camera_body, const TiledCloud& cloud,
                                 const RegistrationOptions& options,
                                 const ReprojectedView& reprojected, int v,
                                 std::span<MeasuredPoints> points, std::span<Agreement> counts,
                                 OutlineAgreement& outline) {
  const RenderedDepth& view = surface.view();
  const PinholeCamera& camera = cloud.camera();
  const kernels::Reprojected row = reprojected.row(v);
  std::size_t sample = surface.samples_before(v);
  for (int u = 0; u < view.width; ++u) {
    const std::size_t pixel = index(view.width, u, v);
    if (view.id[pixel] == kNothing || sample++ % kStride != 0) {
      continue;
    }
    look_beyond(surface, {u, v}, cloud, options, outline);
    const auto body = static_cast<std::size_t>(view.id[pixel]);
    const std::int32_t seen = row.pixel[u];
    if (seen == kernels::kUndecided) {
      count(model, surface.sample(u, v), T_camera_body[body], cloud, options, counts[body]);
    } else if (seen != kernels::kOutside && row.measured[u] <= 0.0F) {
      ++counts[body].samples;
      ++counts[body].unknown;
    } else if (seen != kernels::kOutside) {
      MeasuredPoints& of_body = points[body];
      const std::size_t i = of_body.size++;
      const float z = row.measured[u];
      const std::int32_t seen_row = seen / camera.width;
      const std::int32_t seen_column = seen % camera.width;
      of_body.x[i] = (static_cast<float>(seen_column) - static_cast<float>(camera.cx)) /
                     static_cast<float>(camera.fx) * z;
      of_body.y[i] = (static_cast<float>(seen_row) - static_cast<float>(camera.cy)) /
                     static_cast<float>(camera.fy) * z;
      of_body.z[i] = z;
      of_body.expected[i] = row.expected[u];
      of_body.view_pixel[i] = static_cast<std::uint32_t>(pixel);
    }
  }
}

/// Counts the points collected, and forgets them.
void AgreementMeter::count_points(const ArticulatedModel& model, const VisibleSurface& surface,
                                  std::size_t body, const Eigen::Isometry3d& T_camera_body,
                                  const TiledCloud& cloud, const RegistrationOptions& options,
                                  MeasuredPoints& points, Agreement& counts) {
  const std::size_t size = points.size;
  if (size == 0) {
    return;
  }
  points.size = 0;
  const std::size_t padded = kernels::padded(size);
  for (auto* array : {&points.x, &points.y, &points.z}) {
    std::fill(array->begin() + static_cast<std::ptrdiff_t>(size),
              array->begin() + static_cast<std::ptrdiff_t>(padded), kernels::kPadding);
  }
  kernels::look_up_distance(model.fields[body]->view(), to_rigid_motion(T_camera_body.inverse()),
                            {points.x.data(), points.y.data(), points.z.data(), padded},
                            points.distance.data());
  for (std::size_t i = 0; i < size; ++i) {
    const float gate = static_cast<float>(
        options.cut * options.noise.sigma_z(static_cast<double>(points.expected[i])));
    const float distance = std::abs(points.distance[i]);
    const float behind = points.z[i] - points.expected[i];
    if (distance < gate - kRounding) {
      ++counts.samples;
      ++counts.explained;
    } else if (distance > gate + kRounding && std::abs(behind) > kRounding) {
      ++counts.samples;
      ++(behind > 0.0F ? counts.contradicted : counts.occluded);
    } else {
      const auto width = static_cast<std::uint32_t>(surface.view().width);
      count(model,
            surface.sample(static_cast<int>(points.view_pixel[i] % width),
                           static_cast<int>(points.view_pixel[i] / width)),
            T_camera_body, cloud, options, counts);
    }
  }
}

}  // namespace lockbox
