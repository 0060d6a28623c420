// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "agreement_patch.hpp"
#include "distance_rounding.hpp"
#include "lockbox/registration/rigid_motion.hpp"
#include "outline.hpp"

namespace lockbox {
namespace {

constexpr int kBeyond = 3;  // pixels of the view, across an outline
/// A board on a wall stands out by less than a pixel's noise allows. But a whole side of an outline
/// across which the scene steps back in the mean, by so many standard deviations, ends there. A
/// plate that is imagined aslant in a wall has it behind on one side, too, but within as beyond.
constexpr double kStepsBack = 1.25;
/// A body most of whose points lie behind it, though within the gate, is not what they lie on: of a
/// flat part that is elsewhere they show the face that it would lie on. What recedes by less than
/// this is the model's inexactness, and with few points, that err alike, noise: so many of its
/// standard deviations, if each point's way were drawn by lot.
constexpr double kMayRecede = 0.25;
constexpr double kRecedesByNoise = 3.0;
constexpr double kScatter = 0.57;  // of (-1, 0, 1) for (before, near, behind) by one sigma

std::size_t index(int width, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(u);
}

/// Adds one sample to what it says of its body; nothing if it lies outside the image.
void count(const ArticulatedModel& model, const ViewSample& sample,
           const Eigen::Isometry3d& T_camera_body, const TiledCloud& cloud,
           const RegistrationOptions& options, Agreement& counts) {
  const Eigen::Vector3d p = T_camera_body * sample.p_body.cast<double>();
  const PinholeCamera& camera = cloud.camera();
  const auto pixel = camera.pixel_of(p);
  if (!pixel) {
    return;
  }
  counts.pixels += sample.pixels;
  const auto measured = static_cast<double>(cloud.depth()[index(camera.width, pixel->u, pixel->v)]);
  if (measured <= 0.0) {
    counts.unknown += sample.pixels;
    return;
  }
  const Eigen::Vector3d q = camera.back_project(pixel->u, pixel->v, measured);
  const double distance =
      static_cast<double>(model.fields[static_cast<std::size_t>(sample.body)]
                              ->sample((T_camera_body.inverse() * q).cast<float>())
                              .distance);
  const double sigma = options.noise.sigma_z(p.z());
  if (std::abs(distance) < options.cut * sigma) {
    count_explained(sample.pixels, measured - p.z(), sigma, counts);
  } else {
    (measured > p.z() ? counts.contradicted : counts.occluded) += sample.pixels;
  }
}

/// What is measured in a pixel of the view, behind what is expected there, in standard deviations;
/// nothing if nothing is.
std::optional<double> behind(const VisibleSurface& surface, const Pixel& pixel, double expected,
                             const TiledCloud& cloud, const RegistrationOptions& options) {
  const Pixel seen = surface.camera_pixel(pixel.u, pixel.v);
  const auto measured =
      static_cast<double>(cloud.depth()[index(cloud.camera().width, seen.u, seen.v)]);
  if (measured <= 0.0) return std::nullopt;
  return (measured - expected) / options.noise.sigma_z(expected);
}

/// Most samples lie so: the model is to be seen to all sides of them.
bool shows_model_around(const RenderedDepth& view, const Pixel& sample) {
  if (sample.u < kBeyond || sample.v < kBeyond || sample.u >= view.width - kBeyond ||
      sample.v >= view.height - kBeyond) {
    return false;
  }
  const auto beyond = static_cast<std::ptrdiff_t>(kBeyond);
  const std::int16_t* const id = &view.id[index(view.width, sample.u, sample.v)];
  const std::ptrdiff_t down = beyond * view.width;
  return ((id[-beyond] != kNothing) & (id[beyond] != kNothing) & (id[-down] != kNothing) &
          (id[down] != kNothing)) != 0;
}

/// Looks across the outline, if the sample lies at one: left, right, up and down.
void look_beyond(const VisibleSurface& surface, const Pixel& sample, const TiledCloud& cloud,
                 const RegistrationOptions& options, std::span<OutlineSide, 4> sides) {
  const RenderedDepth& view = surface.view();
  if (shows_model_around(view, sample)) return;
  constexpr std::array<std::array<int, 2>, 4> kWays{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    const auto& [du, dv] = kWays[way];
    const int u = sample.u + kBeyond * du;
    const int v = sample.v + kBeyond * dv;
    if (u < 0 || v < 0 || u >= view.width || v >= view.height ||
        view.id[index(view.width, u, v)] != kNothing) {
      continue;
    }
    const TangentPlane plane(view, sample.u, sample.v);
    const double here = static_cast<double>(view.depth[index(view.width, sample.u, sample.v)]);
    const double there = here * plane.relative_depth(kBeyond * du, kBeyond * dv);
    const auto beyond = behind(surface, {u, v}, there, cloud, options);
    if (beyond && *beyond < -options.cut) {
      continue;
    }
    ++sides[way].pixel_by_pixel.samples;
    if (!beyond) continue;
    sides[way].pixel_by_pixel.goes_on += *beyond < options.cut ? 1 : 0;
    const auto within = behind(surface, sample, here, cloud, options);
    if (!within || *within < -options.cut) continue;
    ++sides[way].measured;
    sides[way].step += std::min(*beyond, options.cut) - std::min(*within, options.cut);
  }
}

void add(std::span<const OutlineSide, 4> sides, std::span<OutlineSide, 4> sums) {
  for (std::size_t way = 0; way < sides.size(); ++way) {
    sums[way].pixel_by_pixel.samples += sides[way].pixel_by_pixel.samples;
    sums[way].pixel_by_pixel.goes_on += sides[way].pixel_by_pixel.goes_on;
    sums[way].measured += sides[way].measured;
    sums[way].step += sides[way].step;
  }
}

/// Of one body. Neighbouring pixels err alike, so that less than a side says little more than one.
void add(std::span<const OutlineSide, 4> sides, OutlineAgreement& outline) {
  for (const auto& [pixel_by_pixel, measured, step] : sides) {
    outline.samples += pixel_by_pixel.samples;
    const bool ends = step > kStepsBack * measured;
    outline.goes_on += ends ? 0 : pixel_by_pixel.goes_on;
  }
}

void add(const Agreement& counts, Agreement& sum) {
  sum.explained += counts.explained;
  sum.contradicted += counts.contradicted;
  sum.occluded += counts.occluded;
  sum.unknown += counts.unknown;
  sum.recedes += counts.recedes;
  sum.patches_behind += counts.patches_behind;
  sum.pixels += counts.pixels;
}

void make_shares(Agreement& counts) {
  if (counts.pixels == 0.0) {
    return;
  }
  for (double* share : {&counts.explained, &counts.contradicted, &counts.occluded, &counts.unknown,
                        &counts.recedes, &counts.patches_behind}) {
    *share /= counts.pixels;
  }
}

/// Counts of one body: what recedes as a whole contradicts it.
void contradict_by_what_recedes(double noise_correlation, Agreement& counts) {
  const double independent = counts.explained / noise_correlation;
  const double by_noise = kRecedesByNoise * kScatter / std::sqrt(independent);
  if (!(counts.recedes > (kMayRecede + by_noise) * counts.explained)) return;
  counts.explained -= counts.recedes;
  counts.contradicted += counts.recedes;
  counts.recedes = 0.0;
}

}  // namespace

struct AgreementMeter::Scene {
  const ArticulatedModel& model;
  const VisibleSurface& surface;
  const ViewSamples& samples;
  const BodyPoses& T_camera_body;
  const TiledCloud& cloud;
  const RegistrationOptions& options;
};

void AgreementMeter::measure(const ArticulatedModel& model, const VisibleSurface& surface,
                             const ViewSamples& samples, const BodyPoses& T_camera_body,
                             const TiledCloud& cloud, const RegistrationOptions& options,
                             const Executor& executor) {
  total_ = {};
  bodies_.assign(T_camera_body.size(), {});
  body_outlines_.assign(T_camera_body.size(), {});
  outline_ = {};
  if (!cloud.has_image()) {
    return;
  }
  reserve(executor);
  const std::size_t chunks = samples.chunks().size();
  chunk_counts_.assign(chunks, {});
  chunk_outlines_.assign(chunks, {});
  const Scene scene{model, surface, samples, T_camera_body, cloud, options};
  executor.for_each(chunks, [&](std::size_t chunk) { look_at_chunk(scene, chunk); });
  for (std::size_t i = 0; i < chunks; ++i) {
    const auto body = static_cast<std::size_t>(samples.chunks()[i].body);
    add(chunk_counts_[i], bodies_[body]);
    add(chunk_outlines_[i], body_outlines_[body]);
  }
  for (const OutlineSides& sides : body_outlines_) add(sides, outline_);
  for (Agreement& body : bodies_) {
    contradict_by_what_recedes(options.noise_correlation, body);
    add(body, total_);
    make_shares(body);
  }
  make_shares(total_);
}

void AgreementMeter::reserve(const Executor& executor) {
  landings_.reserve(executor);
  points_.resize(static_cast<std::size_t>(executor.threads()) + 1);
  for (MeasuredPoints& points : points_) {
    points.number.resize(ViewSamples::kMostInChunk);
    for (auto* array : {&points.x, &points.y, &points.z, &points.expected, &points.distance}) {
      array->resize(ViewSamples::kMostInChunk);
    }
  }
}

/// Counts what needs no field, and collects the measured points of which a field has to tell how
/// far they lie from the body.
void AgreementMeter::look_at_chunk(const Scene& scene, std::size_t chunk_index) {
  const ViewSamples::Chunk& chunk = scene.samples.chunks()[chunk_index];
  const auto& T_camera_body = scene.T_camera_body[static_cast<std::size_t>(chunk.body)];
  const kernels::Landings landings =
      landings_.land(scene.samples, chunk, scene.T_camera_body, scene.cloud);
  MeasuredPoints& points = points_[Executor::worker()];
  points.size = 0;
  Agreement& counts = chunk_counts_[chunk_index];
  for (std::size_t k = 0; k < chunk.count; ++k) {
    const ViewSample sample = scene.samples.sample(chunk.body, chunk.first + k);
    look_beyond(scene.surface, sample.pixel, scene.cloud, scene.options,
                chunk_outlines_[chunk_index]);
    const std::int32_t seen = landings.pixel[k];
    if (seen == kernels::kUndecided) {
      count(scene.model, sample, T_camera_body, scene.cloud, scene.options, counts);
    } else if (seen != kernels::kOutside && landings.measured[k] <= 0.0F) {
      counts.pixels += sample.pixels;
      counts.unknown += sample.pixels;
    } else if (seen != kernels::kOutside) {
      const std::size_t i = points.size++;
      points.x[i] = landings.x[k];
      points.y[i] = landings.y[k];
      points.z[i] = landings.measured[k];
      points.expected[i] = landings.expected[k];
      points.number[i] = static_cast<std::uint32_t>(k);
    }
  }
  count_points(scene, chunk, points, counts);
}

void AgreementMeter::count_points(const Scene& scene, const ViewSamples::Chunk& chunk,
                                  MeasuredPoints& points, Agreement& counts) {
  const auto body = static_cast<std::size_t>(chunk.body);
  const Eigen::Isometry3d& T_camera_body = scene.T_camera_body[body];
  const std::size_t padded = kernels::padded(points.size);
  for (auto* array : {&points.x, &points.y, &points.z}) {
    std::fill(array->begin() + static_cast<std::ptrdiff_t>(points.size),
              array->begin() + static_cast<std::ptrdiff_t>(padded), kernels::kPadding);
  }
  kernels::look_up_distance(
      scene.model.fields[body]->view(), to_rigid_motion(T_camera_body.inverse()),
      {points.x.data(), points.y.data(), points.z.data(), padded}, points.distance.data());
  AgreementPatch patch(scene.options, scene.surface.reduction(), counts);
  for (std::size_t i = 0; i < points.size; ++i) {
    const double sigma = scene.options.noise.sigma_z(static_cast<double>(points.expected[i]));
    const auto gate = static_cast<float>(scene.options.cut * sigma);
    const float distance = std::abs(points.distance[i]);
    const float behind = points.z[i] - points.expected[i];
    const ViewSample sample = scene.samples.sample(chunk.body, chunk.first + points.number[i]);
    if (distance < gate - kDistanceRounding) {
      counts.pixels += sample.pixels;
      patch.explain(sample, static_cast<double>(behind), sigma);
    } else if (distance > gate + kDistanceRounding && behind > kDistanceRounding) {
      counts.pixels += sample.pixels;
      patch.contradict(sample, static_cast<double>(behind), sigma);
    } else if (distance > gate + kDistanceRounding && behind < -kDistanceRounding) {
      counts.pixels += sample.pixels;
      counts.occluded += sample.pixels;
    } else {
      count(scene.model, sample, T_camera_body, scene.cloud, scene.options, counts);
    }
  }
  patch.close();
}

}  // namespace lockbox
