// SPDX-License-Identifier: BSD-3-Clause
#include "scene_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lockbox {
namespace {

constexpr double kMedianToDeviation = 1.4826;  // of a normal distribution
constexpr int kRowsApart = 3;                  // neighbouring rows err alike
constexpr std::size_t kEnoughCells = 100;      // for a median to be one
constexpr double kLeastOfProfile = 0.3;        // of the sensor's noise is left in a cell, at least

/// From second differences along rows: zero on planes, and few cells lie at contours.
double noise_of(const std::vector<float>& cells, int width, int height) {
  std::vector<float> bends;
  bends.reserve(cells.size() / kRowsApart + 1);
  for (int v = 0; v < height; v += kRowsApart) {
    const auto row = cells.begin() + static_cast<std::ptrdiff_t>(v) * width;
    for (int u = 1; u + 1 < width; ++u) {
      if (row[u - 1] > 0.0F && row[u] > 0.0F && row[u + 1] > 0.0F) {
        bends.push_back(std::abs(row[u - 1] - 2.0F * row[u] + row[u + 1]));
      }
    }
  }
  if (bends.size() < kEnoughCells) return 0.0;
  const auto middle = bends.begin() + static_cast<std::ptrdiff_t>(bends.size() / 2);
  std::nth_element(bends.begin(), middle, bends.end());
  constexpr double kVariances = 6.0;  // 1 + 4 + 1
  return kMedianToDeviation * double{*middle} / std::sqrt(kVariances);
}

}  // namespace

double normal_density(double distance, double deviation) {
  const double z = distance / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2.0 * std::numbers::pi));
}

SceneCells::SceneCells(const CoarseView& view, double sensor_noise, double tolerance,
                       const EvidenceOptions& options)
    : options_(options), camera_(view.camera), cells_(view.depth.size()), tolerance_(tolerance) {
  std::transform(view.depth.begin(), view.depth.end(), cells_.begin(),
                 [](float z) { return z > 0.0F ? 1.0F / z : 0.0F; });
  noise_ = std::max(noise_of(cells_, width(), height()), kLeastOfProfile * sensor_noise);
  all_noise_ = std::max(noise_, sensor_noise);
}

double SceneCells::deviation(double inverse_depth) const {
  return std::hypot(all_noise_, tolerance_ * inverse_depth * inverse_depth);
}

double SceneCells::deviation(double inverse_depth, const Sight& sight) const {
  return std::hypot(noise_, tolerance_ * inverse_depth * inverse_depth,
                    noise_ * std::sqrt(sight.variances()));
}

int SceneCells::contour_reach(double inverse_depth) const {
  const double cells_a_metre = camera_.fx * inverse_depth;
  return static_cast<int>(std::ceil(options_.contour_tolerance * cells_a_metre +
                                    options_.contour_pixels * width() / 640.0));
}

double SceneCells::density(int u, int v) const {
  const double cell = at(u, v);
  double sum = 0.0;
  int seen = 0;
  for (const Sight& sight : kSights) {
    const int far_u = u + sight.far * sight.du;
    const int far_v = v + sight.far * sight.dv;
    if (!contains(far_u, far_v)) continue;
    const double near = at(u + sight.near * sight.du, v + sight.near * sight.dv);
    const double far = at(far_u, far_v);
    if (!(near > 0.0 && far > 0.0)) continue;
    // As high as that of a model that agrees: only contours tell the two apart.
    const double wide = deviation(cell, sight);
    sum += normal_density(cell - sight.foretold(near, far), wide) * wide / deviation(cell);
    ++seen;
  }
  const double anywhere = 1.0 / options_.inverse_range;
  if (seen == 0) return anywhere;
  return (1.0 - options_.contours) * sum / seen + options_.contours * anywhere;
}

}  // namespace lockbox
