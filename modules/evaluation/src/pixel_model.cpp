// SPDX-License-Identifier: BSD-3-Clause
#include "pixel_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "jitter.hpp"

namespace lockbox {
namespace {

constexpr double kDepthUnit = 0.001;  // metres, of what a sensor delivers
constexpr double kRefinement = SampledView::kRefinement;

double square(double x) {
  return x * x;
}

/// Density of the jitter, at offset + shift samples for all offsets within reach.
std::vector<double> jitter_weights(double sigma, int reach, double shift) {
  std::vector<double> weights;
  for (int i = -reach; i <= reach; ++i)
    weights.push_back(std::exp(-0.5 * square((i + shift) / sigma)));
  return weights;
}

}  // namespace

/// Flow of a surface point in the image, pixels by the twist of its body in the camera's frame.
struct PixelModeler::Motion {
  Twist u;
  Twist v;
};

PixelModeler::PixelModeler(const SampledView& view, const SensorModel& sensor, int bodies)
    : view_(view),
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

// A surface point p moves with v + w x p: its depth with e_z.v + (p_y, -p_x, 0).w.
Twist PixelModeler::disparity_rate(int u, int v) const {
  const double d = static_cast<double>(view_.disparity(u, v));
  const double z = static_cast<double>(view_.unit_disparity_depth()) / d;
  const Eigen::Vector3d p = view_.sample_camera().back_project(u, v, z);
  Twist rate;
  rate << 0.0, 0.0, 1.0, p.y(), -p.x(), 0.0;
  return -d / z * rate;
}

PixelModeler::Motion PixelModeler::image_motion(int u, int v) const {
  const PinholeCamera& camera = view_.sample_camera();
  const double z = static_cast<double>(view_.unit_disparity_depth() / view_.disparity(u, v));
  const Eigen::Vector3d p = camera.back_project(u, v, z);
  const double x = p.x() / z;
  const double y = p.y() / z;
  Motion motion;
  motion.u << 1.0, 0.0, -x, -x * p.y(), z + x * p.x(), -p.y();
  motion.v << 0.0, 1.0, -y, -z - y * p.y(), y * p.x(), p.x();
  motion.u *= camera.fx / (kRefinement * z);
  motion.v *= camera.fy / (kRefinement * z);
  return motion;
}

double PixelModeler::independent_variance(double disparity) const {
  const double z = static_cast<double>(view_.unit_disparity_depth()) / disparity;
  const double depth_noise = sensor_.depth_noise + sensor_.depth_noise_growth * square(z - 0.4);
  const double depth_variance = square(depth_noise) + square(kDepthUnit) / 12.0;
  const double own_noise = sensor_.correlation_length > 0.0 ? 0.0 : sensor_.disparity_noise;
  return square(own_noise) + square(sensor_.disparity_step) / 12.0 +
         square(disparity / z) * depth_variance;
}

void PixelModeler::add(PixelModel& pixel, int id, const Twist& derivative) const {
  if (id < 0 || id >= bodies_) return;
  const auto found = std::find_if(pixel.derivatives.begin(), pixel.derivatives.end(),
                                  [id](const auto& entry) { return entry.body == id; });
  if (found == pixel.derivatives.end()) {
    pixel.derivatives.push_back({id, derivative});
  } else {
    found->derivative += derivative;
  }
}

void PixelModeler::model(int u, int v, PixelModel& pixel) const {
  pixel.measured = 0.0;
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
  pixel.variance =
      independent_variance(disparity) + jitter_variance_ * (square(slope_u) + square(slope_v));
  const Motion motion = image_motion(sample_u, sample_v);
  add(pixel, view_.id(sample_u, sample_v),
      disparity_rate(sample_u, sample_v) - slope_u * motion.u - slope_v * motion.v);
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
  const Motion motion = image_motion(nearer_u, nearer_v);
  const double scale = -weight * static_cast<double>(next - here) * kRefinement;
  add(pixel, view_.id(nearer_u, nearer_v), scale * (next_u > u ? motion.u : motion.v));
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
  if (view_.disparity(u, v) == 0.0F) return;
  blur.add(weight, static_cast<double>(view_.disparity(u, v)));
  add(pixel, view_.id(u, v), weight * disparity_rate(u, v));
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
  const double mean = blur.mean / blur.total;
  const double at_edge = blur.nearest - blur.farthest > 1.0 ? sensor_.edge_dropout_rate : 0.0;
  pixel.measured = blur.total / blur.inside * (1.0 - sensor_.dropout_rate) * (1.0 - at_edge);
  pixel.variance =
      independent_variance(mean) + std::max(0.0, blur.squares / blur.total - square(mean));
  for (auto& entry : pixel.derivatives) entry.derivative /= blur.total;
}

}  // namespace lockbox
