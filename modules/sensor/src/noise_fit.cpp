// SPDX-License-Identifier: BSD-3-Clause
#include "noise_fit.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "lockbox/core/square.hpp"

namespace lockbox {
namespace {

using Bin = NoiseRecord::Bin;
// What is plausible, metres and 1/metre: an image without planes must not make gates of metres.
constexpr double kLeastFloor = 1e-4;
constexpr double kMostFloor = 0.01;
constexpr double kLeastQuadratic = 1e-5;
constexpr double kMostQuadratic = 0.01;  // a D4xx has 0.0055
constexpr double kLongest = 10.0;        // pixels
/// Of the variance, that the last lag has to show to tell the rest. Unit: a share. Source: at eight
/// pixels it shows a third of what is alike over seven. Doubled, a D4xx's noise is a third too
/// small.
constexpr double kLeastShown = 0.15;
/// What a bin's deviation may be off by: as a share, for what is seen is not all planes; and the
/// differences whose share of it is 1, for neighbouring ones err alike.
constexpr double kShape = 0.1;
constexpr double kAlike = 50.0;
/// What a bin is above the curve, as a factor, from which on it counts for a tenth. Doubled, what
/// is seen of edges makes an SR300's noise a fifth too large.
constexpr double kShaped = 1.6;
constexpr double kOfShapes = 0.1;
/// The floor is taken for the default where the depths that are seen do not tell it, give or take
/// so many metres. Doubled, what is seen at two metres says twice as wrongly what to expect at one.
constexpr double kFloorPrior = 0.001;

/// Sums over the bins of weights, and of what is fitted: sigma = floor + quadratic z^2.
struct Sums {
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();   ///< of (1, z^2)
  Eigen::Vector2d products = Eigen::Vector2d::Zero();  ///< of (1, z^2) and sigma
};

/// Relative errors of the bins count. What is above the noise is shape rather than noise.
Sums sums_over(const NoiseRecord::Bins& bins, const std::optional<SensorNoise>& noise) {
  Sums sums;
  for (const Bin& bin : bins) {
    if (bin.count <= 0.0) continue;
    const double sigma = std::max(kLeastFloor, std::sqrt(bin.variance / kDifferenceVariance));
    double weight = 1.0 / (square(sigma) * (square(kShape) + kAlike / bin.count));
    if (noise && sigma > kShaped * noise->sigma_z(bin.depth)) weight *= kOfShapes;
    const Eigen::Vector2d row(1.0, square(bin.depth));
    sums.squares += weight * row * row.transpose();
    sums.products += weight * sigma * row;
  }
  return sums;
}

double floor_of(const Sums& sums) {
  Eigen::Matrix2d squares = sums.squares;
  Eigen::Vector2d products = sums.products;
  squares(0, 0) += 1.0 / square(kFloorPrior);
  products[0] += SensorNoise{}.depth_floor / square(kFloorPrior);
  return (squares.inverse() * products)[0];
}

/// Fits the curve through the bins. Returns false where that is more than sensors err.
bool fit_curve(const Sums& sums, double rounding, SensorNoise& noise) {
  const double weights = sums.squares(0, 0);
  if (weights == 0.0) return false;
  const double mean_sigma = sums.products[0] / weights;
  const double mean_z2 = sums.squares(0, 1) / weights;
  // No sensor errs less than its depths are rounded.
  const double least_floor = std::max(kLeastFloor, rounding / std::sqrt(12.0));
  double floor = std::clamp(floor_of(sums), least_floor, kMostFloor);
  double quadratic = (sums.products[1] - sums.squares(0, 1) * floor) / sums.squares(1, 1);
  if (quadratic > kMostQuadratic || mean_sigma > kMostFloor * std::max(1.0, mean_z2)) return false;
  if (quadratic < kLeastQuadratic) {
    quadratic = kLeastQuadratic;
    floor = std::clamp(mean_sigma - quadratic * mean_z2, least_floor, kMostFloor);
  }
  noise.depth_floor = floor;
  noise.depth_linear = 0.0;
  noise.depth_quadratic = quadratic;
  return true;
}

/// Fits the growth through the deviations of the bins.
bool fit_growth(const NoiseRecord::Bins& bins, double rounding, SensorNoise& noise) {
  constexpr int kRounds = 3;
  if (!fit_curve(sums_over(bins, std::nullopt), rounding, noise)) return false;
  for (int round = 0; round < kRounds; ++round) {
    if (!fit_curve(sums_over(bins, noise), rounding, noise)) return false;
  }
  return true;
}

/// Variance of D_k over that of independent errors, without what bends.
double expected_variance(double own_share, double length, int lag) {
  const auto rho = [length](int distance) { return std::exp(-0.5 * square(distance / length)); };
  const double shared = 1.0 - square(own_share);
  const auto of = [&](int k) {
    return 1.0 - shared * (8.0 * rho(k) - 2.0 * rho(2 * k)) / kDifferenceVariance;
  };
  return std::max(0.0, (16.0 * of(lag) - of(2 * lag)) / 15.0);
}

/// Standard deviation of D_k as it was seen, beside that of the last lag. The median over what was
/// seen: at some depths there may be more edges than planes.
double seen_ratio(const NoiseRecord::Bins& bins, const NoiseRecord::Bins& unlike) {
  std::vector<std::pair<double, double>> ratios;  // of variances, with their weights
  double all = 0.0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    if (bins[b].count <= 0.0 || unlike[b].count <= 0.0 || unlike[b].variance <= 0.0) continue;
    ratios.emplace_back(bins[b].variance / unlike[b].variance, unlike[b].count);
    all += unlike[b].count;
  }
  std::sort(ratios.begin(), ratios.end());
  double below = 0.0;
  for (const auto& [ratio, weight] : ratios) {
    below += weight;
    if (below >= 0.5 * all) return std::sqrt(ratio);
  }
  return 1.0;
}

/// How alike errors are. Returns the share of their variance that the last lag shows.
double fit_correlation(std::span<const NoiseRecord::Bins> bins, SensorNoise& noise) {
  constexpr double kLengthStep = 0.25;  // pixels
  constexpr double kShareStep = 0.05;
  // Shapes pass for errors that are alike over many pixels: of what fits as well (ratios are off by
  // a hundredth or two) the shortest. Doubled, an SR300's length is a pixel too short.
  constexpr double kOfLength = 1e-4;  // squared ratios a pixel
  std::array<double, NoiseRecord::kLags.size()> ratios{};
  for (std::size_t k = 0; k < bins.size(); ++k) ratios[k] = seen_ratio(bins[k], bins.back());
  double least = std::numeric_limits<double>::infinity();
  double shown = 1.0;
  const int last = NoiseRecord::kLags[bins.size() - 1];
  for (double length = kLengthStep; length <= kLongest; length += kLengthStep) {
    for (int i = 0; i <= 20; ++i) {
      const double own = kShareStep * i;
      double misfit = kOfLength * length;
      const double of_last = expected_variance(own, length, last);
      if (of_last < kLeastShown) continue;
      for (std::size_t k = 0; k < bins.size(); ++k) {
        const double of_lag = expected_variance(own, length, NoiseRecord::kLags[k]);
        misfit += square(ratios[k] - std::sqrt(of_lag / of_last));
      }
      if (misfit < least) {
        least = misfit;
        noise.own_share = own;
        noise.correlation_pixels = length;
        shown = of_last;
      }
    }
  }
  return shown;
}

}  // namespace

bool fit_noise(std::span<const NoiseRecord::Bins> bins, double rounding, SensorNoise& noise) {
  if (!fit_growth(bins.back(), rounding, noise)) return false;
  const double larger = 1.0 / std::sqrt(fit_correlation(bins, noise));
  noise.depth_floor *= larger;
  noise.depth_quadratic *= larger;
  return noise.depth_quadratic <= kMostQuadratic;
}

}  // namespace lockbox
