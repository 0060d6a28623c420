// SPDX-License-Identifier: BSD-3-Clause
#include "pixel_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jitter.hpp"
#include "lockbox/core/square.hpp"

namespace lockbox {
namespace {

constexpr double kDepthUnit = 0.001;  // metres, of what a sensor delivers
constexpr double kRefinement = SampledView::kRefinement;

/// Density of the jitter, at offset + shift samples for all offsets within reach.
std::vector<double> jitter_weights(double sigma, int reach, double shift) {
  std::vector<double> weights;
  for (int i = -reach; i <= reach; ++i)
    weights.push_back(std::exp(-0.5 * square((i + shift) / sigma)));
  return weights;
}

/// A surface point p, by its ray (x, y, 1) and its depth.
struct SurfacePoint {
  double x;
  double y;
  double z;
};

// p moves with v + w x p under its body's twist (v, w) in the camera's frame: its depth with
// (0, 0, 1).v + (p_y, -p_x, 0).w, its ray with the rest divided by z.

/// Change of the disparity with the twist, pixels.
Twist disparity_rate(const SurfacePoint& p, double disparity) {
  const double scale = -disparity / p.z;
  Twist rate;
  rate << 0.0, 0.0, scale, scale * p.y * p.z, -scale * p.x * p.z, 0.0;
  return rate;
}

/// Flow along the image's rows with the twist, pixels. focal_length: of the image, pixels.
Twist flow_along_u(const SurfacePoint& p, double focal_length) {
  const double scale = focal_length / p.z;
  Twist flow;
  flow << scale, 0.0, -scale * p.x, -focal_length * p.x * p.y, focal_length * (1.0 + p.x * p.x),
      -focal_length * p.y;
  return flow;
}

/// Returns the flow along its columns.
Twist flow_along_v(const SurfacePoint& p, double focal_length) {
  const double scale = focal_length / p.z;
  Twist flow;
  flow << 0.0, scale, -scale * p.y, -focal_length * (1.0 + p.y * p.y), focal_length * p.x * p.y,
      focal_length * p.x;
  return flow;
}

SurfacePoint surface_point(const SampledView& view, int u, int v) {
  const Eigen::Vector3d ray = view.sample_camera().back_project(u, v, 1.0);
  return {
      ray.x(), ray.y(),
      static_cast<double>(view.unit_disparity_depth()) / static_cast<double>(view.disparity(u, v))};
}

}  // namespace

PixelModeler::PixelModeler(const SampledView& view, const PinholeCamera& camera,
                           const SensorModel& sensor, int bodies)
    : view_(view),
      camera_(camera),
      sensor_(sensor),
      bodies_(bodies),
      jitter_variance_(square(effective_jitter(sensor))) {
  const double sigma = effective_jitter(sensor) * kRefinement;
  weights_ = jitter_weights(sigma, view.reach(), 0.0);
  between_weights_ = jitter_weights(sigma, view.reach(), 0.5);
  double sum = 0.0;
  for (const double weight : weights_) sum += weight;
  for (double& weight : weights_) weight /= sum;
  for (double& weight : between_weights_) weight /= sum;
}

double PixelModeler::independent_variance(double disparity) const {
  const double z = static_cast<double>(view_.unit_disparity_depth()) / disparity;
  const double depth_variance = square(white_depth_noise(sensor_, z)) + square(kDepthUnit) / 12.0;
  const double own_noise = sensor_.correlation_length > 0.0 ? 0.0 : sensor_.disparity_noise;
  return square(own_noise) + square(sensor_.disparity_step) / 12.0 +
         square(disparity / z) * depth_variance;
}

void PixelModeler::add(PixelModel& pixel, int body, const Twist& derivative) {
  const auto found = std::find_if(pixel.derivatives.begin(), pixel.derivatives.end(),
                                  [body](const auto& entry) { return entry.body == body; });
  if (found == pixel.derivatives.end()) {
    pixel.derivatives.push_back({body, derivative});
  } else {
    found->derivative += derivative;
  }
}

void PixelModeler::model(int u, int v, PixelModel& pixel) const {
  pixel.measured = 0.0;
  pixel.mean = 0.0;
  pixel.variance = 0.0;
  pixel.derivatives.clear();
  if (view_.is_smooth(u, v)) {
    model_smooth(u, v, pixel);
  } else {
    model_broken(u, v, pixel);
  }
}

void PixelModeler::model_smooth(int u, int v, PixelModel& pixel) const {
  const int sample_u = u * SampledView::kRefinement;
  const int sample_v = v * SampledView::kRefinement;
  const double disparity = static_cast<double>(view_.disparity(sample_u, sample_v));
  if (disparity == 0.0) return;
  const auto slope = [](float before, float after) {
    return static_cast<double>(after - before) * kRefinement / 2.0;
  };
  const double slope_u =
      slope(view_.disparity(sample_u - 1, sample_v), view_.disparity(sample_u + 1, sample_v));
  const double slope_v =
      slope(view_.disparity(sample_u, sample_v - 1), view_.disparity(sample_u, sample_v + 1));
  pixel.measured = 1.0 - sensor_.dropout_rate;
  pixel.mean = disparity;
  pixel.variance =
      independent_variance(disparity) + jitter_variance_ * (square(slope_u) + square(slope_v));
  const std::int16_t id = view_.id(sample_u, sample_v);
  if (!moves(id)) return;
  const SurfacePoint p = surface_point(view_, sample_u, sample_v);
  add(pixel, id,
      disparity_rate(p, disparity) - slope_u * flow_along_u(p, camera_.fx) -
          slope_v * flow_along_v(p, camera_.fy));
}

/// The part of the derivative that comes from the step between two neighbouring samples.
void PixelModeler::add_step(PixelModel& pixel, int u, int v, int next_u, int next_v,
                            double weight) const {
  if (next_u >= view_.width() || next_v >= view_.height()) return;
  const float here = view_.disparity(u, v);
  const float next = view_.disparity(next_u, next_v);
  if (here == 0.0F || next == 0.0F || here == next) return;
  const int nearer_u = here > next ? u : next_u;
  const int nearer_v = here > next ? v : next_v;
  const std::int16_t id = view_.id(nearer_u, nearer_v);
  if (!moves(id)) return;
  const SurfacePoint p = surface_point(view_, nearer_u, nearer_v);
  const double scale = -weight * static_cast<double>(next - here) * kRefinement;
  add(pixel, id, scale * (next_u > u ? flow_along_u(p, camera_.fx) : flow_along_v(p, camera_.fy)));
}

/// Sums over the samples that a pixel may look at.
struct PixelModeler::Blur {
  double inside = 0.0;  ///< weight of the samples in the image
  double total = 0.0;   ///< weight of those that show anything
  double mean = 0.0;
  double squares = 0.0;
  double nearest = 0.0;  ///< largest and smallest disparity
  double farthest = std::numeric_limits<double>::infinity();

  void add(double weight, double disparity) {
    total += weight;
    mean += weight * disparity;
    squares += weight * square(disparity);
    nearest = std::max(nearest, disparity);
    farthest = std::min(farthest, disparity);
  }
};

void PixelModeler::add_sample(PixelModel& pixel, Blur& blur, int u, int v, std::size_t column,
                              std::size_t row) const {
  if (u < 0 || v < 0 || u >= view_.width() || v >= view_.height()) return;
  const double weight = weights_[column] * weights_[row];
  blur.inside += weight;
  const auto disparity = static_cast<double>(view_.disparity(u, v));
  if (disparity == 0.0) return;
  blur.add(weight, disparity);
  const std::int16_t id = view_.id(u, v);
  if (moves(id)) add(pixel, id, weight * disparity_rate(surface_point(view_, u, v), disparity));
  add_step(pixel, u, v, u + 1, v, between_weights_[column] * weights_[row]);
  add_step(pixel, u, v, u, v + 1, weights_[column] * between_weights_[row]);
}

void PixelModeler::model_broken(int u, int v, PixelModel& pixel) const {
  const int reach = view_.reach();
  const int first_u = u * SampledView::kRefinement - reach;
  const int first_v = v * SampledView::kRefinement - reach;
  Blur blur;
  for (int j = 0; j <= 2 * reach; ++j) {
    for (int i = 0; i <= 2 * reach; ++i) {
      add_sample(pixel, blur, first_u + i, first_v + j, static_cast<std::size_t>(i),
                 static_cast<std::size_t>(j));
    }
  }
  if (blur.total == 0.0) return;
  pixel.mean = blur.mean / blur.total;
  const double at_edge = blur.nearest - blur.farthest > 1.0 ? sensor_.edge_dropout_rate : 0.0;
  pixel.measured = blur.total / blur.inside * (1.0 - sensor_.dropout_rate) * (1.0 - at_edge);
  pixel.variance = independent_variance(pixel.mean) +
                   std::max(0.0, blur.squares / blur.total - square(pixel.mean));
  for (auto& entry : pixel.derivatives) entry.derivative /= blur.total;
}

}  // namespace lockbox
