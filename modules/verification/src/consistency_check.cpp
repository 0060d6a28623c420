// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/verification/consistency_check.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/kernels/reprojection.hpp"
#include "lockbox/sdf/distance_rounding.hpp"
#include "lockbox/sdf/rigid_motion.hpp"
#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/view/contour.hpp"
#include "sample_group.hpp"

namespace lockbox {
namespace {

/// A body most of whose points lie behind it, though within the gate, is not what they lie on: of a
/// flat part that is elsewhere they show the face that it would lie on. What recedes by less than
/// share of what is explained is the model's inexactness, and with few points, that err alike,
/// noise: so many standard deviations of the share, if each point's way were drawn by lot.
constexpr double kShareMayRecede = 0.25;
constexpr double kShareSigmas = 3.0;
constexpr double kScatter = 0.57;  // of (-1, 0, 1) for (before, near, behind) by one sigma

/// Returns the deviation of a depth that is measured so far behind the surface, metres. On steep
/// surfaces lateral noise reads as depth, too: that is looked at where noise of the depth alone
/// would not reach.
double deviation(const VisibleSurface& surface, const Pixel& pixel, double expected, double behind,
                 const SensorNoise& noise) {
  const double sigma = noise.sigma_z(expected);
  if (std::abs(behind) <= sigma) return sigma;
  const double steepness = TangentPlane(surface.view(), pixel.u, pixel.v).steepness();
  const double lateral = noise.lateral_pixels * steepness / surface.reduction() * expected;
  return std::sqrt(sigma * sigma + lateral * lateral);
}

/// Whether the surface is measured where it is expected, by so much (metres), in a pixel beside
/// one. Then the contour that passes there may be a pixel off by lateral noise.
bool is_beside(const TiledCloud& cloud, std::int32_t pixel, double expected, double gate) {
  const PinholeCamera& camera = cloud.camera();
  const int u = pixel % camera.width;
  const int v = pixel / camera.width;
  const auto is_there = [&](int way) {
    const auto depth = static_cast<double>(cloud.depth()[static_cast<std::size_t>(pixel + way)]);
    return std::abs(depth - expected) < gate;
  };
  return (u > 0 && is_there(-1)) || (u + 1 < camera.width && is_there(1)) ||
         (v > 0 && is_there(-camera.width)) || (v + 1 < camera.height && is_there(camera.width));
}

/// Where single precision could not tell the pixel that a sample falls into: the number and what is
/// measured there.
void land_exactly(const Eigen::Vector3d& p, const TiledCloud& cloud, std::size_t k,
                  const kernels::Landings& landings) {
  const PinholeCamera& camera = cloud.camera();
  const auto pixel = camera.pixel_of(p);
  landings.pixel[k] = pixel ? pixel->v * camera.width + pixel->u : kernels::kOutside;
  if (!pixel) return;
  landings.measured[k] = cloud.depth()[static_cast<std::size_t>(landings.pixel[k])];
  const Eigen::Vector3d q =
      camera.back_project(pixel->u, pixel->v, static_cast<double>(landings.measured[k]));
  landings.x[k] = static_cast<float>(q.x());
  landings.y[k] = static_cast<float>(q.y());
  landings.expected[k] = static_cast<float>(p.z());
}

/// Metres from a body within which what is measured is explained by it.
double gate(const ViewOptions& options, float expected) {
  return options.gate * options.noise.sigma_z(static_cast<double>(expected));
}

/// Whether the point is as near as that to the sample itself, which lies on the surface and falls
/// into the point's pixel. q: the point, on the ray of the pixel's centre.
bool is_at_sample(const Eigen::Vector3f& q, float expected, double gate,
                  const PinholeCamera& camera) {
  constexpr double kHalfDiagonal = 0.71;  // of a pixel
  constexpr double kSurely = 0.9;         // of the gate
  const auto depth = static_cast<double>(expected);
  const double along =
      std::abs(static_cast<double>(q.z()) - depth) * static_cast<double>(q.norm() / q.z());
  const double across = kHalfDiagonal * depth / std::min(camera.fx, camera.fy);
  return along + across < kSurely * gate;
}

void add(const Agreement& counts, Agreement& sum) {
  sum.explained += counts.explained;
  sum.contradicted += counts.contradicted;
  sum.occluded += counts.occluded;
  sum.unknown += counts.unknown;
  sum.recedes += counts.recedes;
  sum.groups_behind += counts.groups_behind;
  sum.pixels += counts.pixels;
}

void make_shares(Agreement& counts) {
  if (counts.pixels == 0.0) {
    return;
  }
  for (double* share : {&counts.explained, &counts.contradicted, &counts.occluded, &counts.unknown,
                        &counts.recedes, &counts.groups_behind}) {
    *share /= counts.pixels;
  }
}

/// Counts of one body: what recedes as a whole contradicts it.
void contradict_by_what_recedes(double noise_correlation, Agreement& counts) {
  const double independent = counts.explained / noise_correlation;
  const double by_noise = kShareSigmas * kScatter / std::sqrt(independent);
  if (!(counts.recedes > (kShareMayRecede + by_noise) * counts.explained)) return;
  counts.explained -= counts.recedes;
  counts.contradicted += counts.recedes;
  counts.recedes = 0.0;
}

}  // namespace

struct ConsistencyCheck::Scene {
  const ArticulatedModel& model;
  const VisibleSurface& surface;
  const ViewSamples& samples;
  const BodyPoses& T_camera_body;
  const TiledCloud& cloud;
  const ViewOptions& options;
};

void ConsistencyCheck::measure(const ArticulatedModel& model, const VisibleSurface& surface,
                               const ViewSamples& samples, const BodyPoses& T_camera_body,
                               const TiledCloud& cloud, const ViewOptions& options,
                               const Executor& executor, FunctionRef<void()> meanwhile) {
  total_ = {};
  bodies_.assign(T_camera_body.size(), {});
  body_contours_.assign(T_camera_body.size(), {});
  contour_ = {};
  if (!cloud.has_image()) {
    meanwhile();
    return;
  }
  reserve(executor);
  const std::size_t chunks = samples.chunks().size();
  chunk_counts_.assign(chunks, {});
  chunk_contours_.assign(chunks, {});
  const Scene scene{model, surface, samples, T_camera_body, cloud, options};
  executor.for_each({{1, [&](std::size_t) { meanwhile(); }},
                     {chunks, [&](std::size_t i) { look_at_chunk(scene, i); }}});
  for (std::size_t i = 0; i < chunks; ++i) {
    const auto body = static_cast<std::size_t>(samples.chunks()[i].body);
    add(chunk_counts_[i], bodies_[body]);
    add(chunk_contours_[i], body_contours_[body]);
  }
  for (const ContourSides& sides : body_contours_) add(sides, contour_);
  for (Agreement& body : bodies_) {
    contradict_by_what_recedes(options.noise_correlation, body);
    add(body, total_);
    make_shares(body);
  }
  make_shares(total_);
}

void ConsistencyCheck::reserve(const Executor& executor) {
  landings_.reserve(executor);
  points_.resize(static_cast<std::size_t>(executor.threads()) + 1);
  for (MeasuredPoints& points : points_) {
    for (auto* numbers : {&points.number, &points.index}) {
      numbers->resize(ViewSamples::kMostInChunk);
    }
    points.pixel.resize(ViewSamples::kMostInChunk);
    points.is_near.resize(ViewSamples::kMostInChunk);
    for (auto* array :
         {&points.depth, &points.expected, &points.x, &points.y, &points.z, &points.distance}) {
      array->resize(ViewSamples::kMostInChunk);
    }
  }
}

/// Counts what was not measured, and collects what was. Most of it is where it is expected, and no
/// field has to tell that it is near.
void ConsistencyCheck::look_at_chunk(const Scene& scene, std::size_t chunk_index) {
  const ViewSamples::Chunk& chunk = scene.samples.chunks()[chunk_index];
  const auto& T_camera_body = scene.T_camera_body[static_cast<std::size_t>(chunk.body)];
  const kernels::Landings landings =
      landings_.land(scene.samples, chunk, scene.T_camera_body, scene.cloud);
  MeasuredPoints& points = points_[Executor::worker()];
  points.size = 0;
  points.unsure = 0;
  Agreement& counts = chunk_counts_[chunk_index];
  for (std::size_t k = 0; k < chunk.count; ++k) {
    const ViewSample sample = scene.samples.sample(chunk.body, chunk.first + k);
    look_beyond(scene.surface, sample.pixel, scene.cloud, scene.options,
                chunk_contours_[chunk_index]);
    if (landings.pixel[k] == kernels::kUndecided) {
      land_exactly(T_camera_body * sample.p_body.cast<double>(), scene.cloud, k, landings);
    }
    if (landings.pixel[k] == kernels::kOutside) continue;
    counts.pixels += sample.pixels;
    if (landings.measured[k] <= 0.0F) {
      counts.unknown += sample.pixels;
      continue;
    }
    const std::size_t i = points.size++;
    points.depth[i] = landings.measured[k];
    points.expected[i] = landings.expected[k];
    points.number[i] = static_cast<std::uint32_t>(k);
    points.pixel[i] = landings.pixel[k];
    const Eigen::Vector3f q(landings.x[k], landings.y[k], landings.measured[k]);
    points.is_near[i] = is_at_sample(q, points.expected[i], gate(scene.options, points.expected[i]),
                                     scene.cloud.camera());
    if (points.is_near[i] != 0) continue;
    const std::size_t u = points.unsure++;
    points.index[u] = static_cast<std::uint32_t>(i);
    points.x[u] = q.x();
    points.y[u] = q.y();
    points.z[u] = q.z();
  }
  ask_field(scene, chunk.body, points);
  count_points(scene, chunk, points, counts);
}

/// Which of the unsure points are near; those at the gate, which rounding would decide, as with any
/// instruction set.
void ConsistencyCheck::ask_field(const Scene& scene, int body, MeasuredPoints& points) {
  const auto b = static_cast<std::size_t>(body);
  const std::size_t padded = kernels::padded(points.unsure);
  for (auto* array : {&points.x, &points.y, &points.z}) {
    std::fill(array->begin() + static_cast<std::ptrdiff_t>(points.unsure),
              array->begin() + static_cast<std::ptrdiff_t>(padded), kernels::kPadding);
  }
  const Eigen::Isometry3d T_body_camera = scene.T_camera_body[b].inverse();
  kernels::look_up_distance(scene.model.fields[b]->view(), to_rigid_motion(T_body_camera),
                            {points.x.data(), points.y.data(), points.z.data(), padded},
                            points.distance.data());
  for (std::size_t u = 0; u < points.unsure; ++u) {
    const std::size_t i = points.index[u];
    const auto least = static_cast<float>(gate(scene.options, points.expected[i]));
    float distance = points.distance[u];
    if (std::abs(std::abs(distance) - least) <= kDistanceRounding) {
      const Eigen::Vector3d p =
          Eigen::Vector3f(points.x[u], points.y[u], points.z[u]).cast<double>();
      distance = scene.model.fields[b]->sample((T_body_camera * p).cast<float>()).distance;
    }
    points.is_near[i] = std::abs(distance) < least;
  }
}

void ConsistencyCheck::count_points(const Scene& scene, const ViewSamples::Chunk& chunk,
                                    const MeasuredPoints& points, Agreement& counts) {
  const SensorNoise& noise = scene.options.noise;
  const double gate = scene.options.gate;
  SampleGroup group(scene.options, scene.surface.reduction(), counts);
  for (std::size_t i = 0; i < points.size; ++i) {
    const auto expected = static_cast<double>(points.expected[i]);
    const double behind = static_cast<double>(points.depth[i]) - expected;
    const ViewSample sample = scene.samples.sample(chunk.body, chunk.first + points.number[i]);
    const double sigma = deviation(scene.surface, sample.pixel, expected, behind, noise);
    if (behind > gate * sigma && is_beside(scene.cloud, points.pixel[i], expected, gate * sigma)) {
      counts.unknown += sample.pixels;
    } else if (points.is_near[i] != 0) {
      group.explain(sample, behind, sigma);
    } else if (behind > 0.0) {
      group.contradict(sample, behind, sigma);
    } else {
      counts.occluded += sample.pixels;
    }
  }
  group.close();
}

}  // namespace lockbox
