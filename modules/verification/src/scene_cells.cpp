// SPDX-License-Identifier: BSD-3-Clause
#include "scene_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lockbox {
namespace {

/// To the right and down: those to the left and up have the same cells.
constexpr std::array kSightsOfNoise{kSights[0], kSights[2]};
/// The same of cells side by side, which bend by one step of the sensor's resolution, if at all.
constexpr std::array<Sight, 2> kSightsOfRounding{{{1, 0, 1, 2}, {0, 1, 1, 2}}};
/// What a cell errs by at most. Unit: steps. Source: the nearest one is taken. Doubled, a sensor
/// that rounds to 1/8 pixel loses half of its contours at 3 m.
constexpr double kMostOfRounding = 0.5;
constexpr double kMedianToDeviation = 1.4826;  // of a normal distribution
constexpr int kRowsApart = 6;                  // as far as a sight reaches: others err alike
constexpr std::ptrdiff_t kEnoughCells = 100;   // for a median to be one
constexpr double kLeastOfProfile = 0.3;        // of the sensor's noise is left in a cell, at least

/// Returns how far cells are off from what is foretold by a sight, in deviations of a pixel's
/// noise.
std::vector<float> off_in(const std::vector<float>& cells, int width, int height,
                          const Sight& sight, const SensorNoise& sensor) {
  std::vector<float> off;
  off.reserve(cells.size() / kRowsApart + static_cast<std::size_t>(width));
  const auto step = static_cast<std::ptrdiff_t>(sight.dv) * width + sight.du;
  const double deviations = std::sqrt(1.0 + sight.variances());
  for (int v = 0; v + sight.far * sight.dv < height; v += kRowsApart) {
    for (int u = 0; u + sight.far * sight.du < width; ++u) {
      const auto here = cells.begin() + static_cast<std::ptrdiff_t>(v) * width + u;
      const float near = here[sight.near * step];
      const float far = here[sight.far * step];
      if (!(*here > 0.0F && near > 0.0F && far > 0.0F)) continue;
      const double sigma = deviations * sensor.sigma_inverse(*here);
      off.push_back(static_cast<float>(std::abs(sight.foretold(near, far) - *here) / sigma));
    }
  }
  return off;
}

/// Returns the deviation of noise, without what is off by more than `agree` of it, which lies at
/// contours. It is infinite where there is too little.
double deviation_of_noise(std::vector<float>& off, double agree) {
  double deviation = std::numeric_limits<double>::infinity();
  for (auto end = off.end(); end - off.begin() >= kEnoughCells;) {
    const auto middle = off.begin() + (end - off.begin()) / 2;
    std::nth_element(off.begin(), middle, end);
    deviation = kMedianToDeviation * double{*middle};
    const auto most = static_cast<float>(agree * deviation);
    const auto noise = std::partition(middle, end, [&](float one) { return one <= most; });
    if (noise == end) break;
    end = noise;
  }
  return deviation;
}

/// Returns how far rounding makes a cell err, as a share of a pixel's noise. On planes cells that
/// are rounded err alike along whole lines, so that it is the most that counts. Where nothing is
/// rounded, half of the cells' noise comes of it, or less.
double share_of_rounding(const std::vector<float>& cells, int width, int height,
                         const SensorNoise& sensor) {
  double share = std::numeric_limits<double>::infinity();
  for (const Sight& sight : kSightsOfRounding) {
    std::vector<float> off = off_in(cells, width, height, sight, sensor);
    off.erase(std::remove(off.begin(), off.end(), 0.0F), off.end());
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size()) / 2;
    if (middle - off.begin() < kEnoughCells) continue;
    std::nth_element(off.begin(), middle, off.end());
    const double step = std::sqrt(1.0 + sight.variances()) * double{*middle};
    share = std::min(share, kMostOfRounding * step);
  }
  return std::isfinite(share) ? share : 0.0;
}

/// Returns what a cell errs by beside those from which planes foretell it, as a share of a pixel's
/// noise. That makes contours, however alike neighbours err. A sensor errs alike in rows and
/// columns; what lies in a room, as boards in a shelf, adds more to one of them.
double share_of_noise(const std::vector<float>& cells, int width, int height,
                      const SensorNoise& sensor, double agree) {
  double share = std::numeric_limits<double>::infinity();
  for (const Sight& sight : kSightsOfNoise) {
    std::vector<float> off = off_in(cells, width, height, sight, sensor);
    share = std::min(share, deviation_of_noise(off, agree));
  }
  return std::isfinite(share) ? share : 0.0;
}

}  // namespace

double normal_density(double distance, double deviation) {
  const double z = distance / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2.0 * std::numbers::pi));
}

SceneCells::SceneCells(const CoarseView& view, const SensorNoise& sensor, double tolerance,
                       const EvidenceOptions& options)
    : options_(options),
      camera_(view.camera),
      cells_(view.depth.size()),
      sensor_(sensor),
      tolerance_(tolerance) {
  std::transform(view.depth.begin(), view.depth.end(), cells_.begin(),
                 [](float z) { return z > 0.0F ? 1.0F / z : 0.0F; });
  share_ = std::max({share_of_noise(cells_, width(), height(), sensor, options.agree),
                     share_of_rounding(cells_, width(), height(), sensor), kLeastOfProfile});
}

double SceneCells::deviation(double inverse_depth) const {
  // With what neighbours err by alike.
  return std::hypot(std::max(noise(inverse_depth), sensor_.sigma_inverse(inverse_depth)),
                    tolerance_ * inverse_depth * inverse_depth);
}

double SceneCells::deviation(double inverse_depth, const Sight& sight) const {
  const double here = noise(inverse_depth);
  return std::hypot(here, tolerance_ * inverse_depth * inverse_depth,
                    here * std::sqrt(sight.variances()));
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
