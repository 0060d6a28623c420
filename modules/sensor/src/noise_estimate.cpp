// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/noise_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lockbox/core/square.hpp"

namespace lockbox {
namespace {

constexpr std::array<int, 5> kLags{1, 2, 4, 8, 16};  // pixels
constexpr int kShortLags = 2;     // at which errors are too much alike to tell how large they are
constexpr int kRowsApart = 3;     // neighbouring rows err alike
constexpr double kNearest = 0.2;  // metres, of the first of the bins
constexpr double kBinGrowth = 1.25;   // of the depth from bin to bin
constexpr std::size_t kBins = 16;     // to 7 m
constexpr std::size_t kEnough = 300;  // differences, for a bin to tell
constexpr double kVariances = 6.0;    // 1 + 4 + 1
// What is plausible, metres and 1/metre: an image without planes must not make gates of metres.
constexpr double kLeastFloor = 1e-4;
constexpr double kMostFloor = 0.01;
constexpr double kLeastQuadratic = 1e-5;
constexpr double kMostQuadratic = 0.02;
constexpr double kLongest = 10.0;  // pixels

/// Second differences of 1/z, times z^2: metres along the ray.
struct Difference {
  std::size_t bin;  ///< of the depth
  double z;
  double value;
};

std::optional<std::size_t> bin_of(double z) {
  if (z < kNearest) return std::nullopt;
  const auto bin = static_cast<std::size_t>(std::log(z / kNearest) / std::log(kBinGrowth));
  return bin < kBins ? std::optional(bin) : std::nullopt;
}

std::vector<Difference> differences(const DepthFrame& frame, int lag) {
  std::vector<Difference> result;
  for (int v = 0; v < frame.camera.height; v += kRowsApart) {
    for (int u = lag; u + lag < frame.camera.width; ++u) {
      const double z = frame.metres(u, v);
      const double left = frame.metres(u - lag, v);
      const double right = frame.metres(u + lag, v);
      const auto bin = bin_of(z);
      if (!bin || !(left > 0.0 && right > 0.0)) continue;
      result.push_back({*bin, z, z * z * (1.0 / left - 2.0 / z + 1.0 / right)});
    }
  }
  return result;
}

double quantile(std::vector<double>& sizes, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), sizes.begin() + rank, sizes.end());
  return sizes[static_cast<std::size_t>(rank)];
}

/// Of what is normal but for outliers: what lies beyond 2.5 deviations does not count, again and
/// again. Values are discrete where a sensor rounds: their median would be, too.
double core_deviation(std::vector<double>& sizes) {
  constexpr int kRounds = 12;
  constexpr double kCut = 2.5;
  constexpr double kWithin = 0.9112;  // variance of a normal distribution cut off there
  double deviation = quantile(sizes, 0.5) / 0.6745;  // of a normal distribution
  if (deviation == 0.0) deviation = quantile(sizes, 0.9) / 1.6449;
  for (int round = 0; round < kRounds; ++round) {
    double squares = 0.0;
    double count = 0.0;
    for (const double size : sizes) {
      if (size > kCut * deviation) continue;
      squares += size * size;
      count += 1.0;
    }
    if (count == 0.0) break;
    deviation = std::sqrt(squares / count / kWithin);
  }
  return deviation;
}

/// floor + quadratic z^2 through the deviations of the bins, relative errors weighted by numbers.
/// False where that is more than sensors err: then it is the shape of what is seen.
bool fit_growth(const std::vector<Difference>& differences, SensorNoise& noise) {
  std::array<std::vector<double>, kBins> sizes;
  std::array<double, kBins> depths{};
  for (const Difference& d : differences) {
    sizes[d.bin].push_back(std::abs(d.value));
    depths[d.bin] += d.z;
  }
  double s11 = 0.0;
  double s12 = 0.0;
  double s22 = 0.0;
  double r1 = 0.0;
  double r2 = 0.0;
  for (std::size_t b = 0; b < kBins; ++b) {
    if (sizes[b].size() < kEnough) continue;
    const double sigma = std::max(kLeastFloor, core_deviation(sizes[b]) / std::sqrt(kVariances));
    const double z2 = square(depths[b] / static_cast<double>(sizes[b].size()));
    const double weight = static_cast<double>(sizes[b].size()) / square(sigma);
    s11 += weight;
    s12 += weight * z2;
    s22 += weight * z2 * z2;
    r1 += weight * sigma;
    r2 += weight * sigma * z2;
  }
  if (s11 == 0.0) return false;
  const double determinant = s11 * s22 - s12 * s12;
  const bool tells_both = determinant > 1e-3 * s11 * s22;
  double floor = tells_both ? (s22 * r1 - s12 * r2) / determinant : SensorNoise{}.depth_floor;
  floor = std::clamp(floor, kLeastFloor, kMostFloor);
  double quadratic = (r2 - s12 * floor) / s22;
  if (quadratic < kLeastQuadratic) floor = std::clamp(r1 / s11, kLeastFloor, kMostFloor);
  if (quadratic > kMostQuadratic || r1 / s11 > kMostFloor) return false;
  noise.depth_floor = floor;
  noise.depth_linear = 0.0;
  noise.depth_quadratic = std::clamp(quadratic, kLeastQuadratic, kMostQuadratic);
  return true;
}

/// Standard deviation of D_k over that of independent errors.
double expected_ratio(double own_share, double length, int lag) {
  const auto rho = [length](int distance) { return std::exp(-0.5 * square(distance / length)); };
  const double shared = 1.0 - square(own_share);
  return std::sqrt(
      std::max(0.0, 1.0 - shared * (8.0 * rho(lag) - 2.0 * rho(2 * lag)) / kVariances));
}

void fit_correlation(const std::array<double, kLags.size()>& ratios, SensorNoise& noise) {
  constexpr double kLengthStep = 0.25;  // pixels
  constexpr double kShareStep = 0.05;
  double least = std::numeric_limits<double>::infinity();
  for (double length = kLengthStep; length <= kLongest; length += kLengthStep) {
    for (int i = 0; i <= 20; ++i) {
      const double own = kShareStep * i;
      double misfit = 0.0;
      for (std::size_t k = 0; k < kLags.size(); ++k) {
        misfit += square(ratios[k] - expected_ratio(own, length, kLags[k]));
      }
      if (misfit < least) {
        least = misfit;
        noise.own_share = own;
        noise.correlation_pixels = length;
      }
    }
  }
}

}  // namespace

std::optional<SensorNoise> estimate_noise(const DepthFrame& frame) {
  SensorNoise noise;
  // Of small things few faces are as wide as two of the longest lags.
  const auto tells = [&](int lag) { return fit_growth(differences(frame, lag), noise); };
  if (std::none_of(kLags.rbegin(), kLags.rend() - kShortLags, tells)) return std::nullopt;
  std::array<double, kLags.size()> ratios{};
  for (std::size_t k = 0; k < kLags.size(); ++k) {
    const std::vector<Difference> found = differences(frame, kLags[k]);
    std::vector<double> sizes;
    sizes.reserve(found.size());
    for (const Difference& d : found) sizes.push_back(std::abs(d.value) / noise.sigma_z(d.z));
    ratios[k] = core_deviation(sizes) / std::sqrt(kVariances);
  }
  const double all = std::max(ratios.back(), 1e-6);
  for (double& ratio : ratios) ratio /= all;
  fit_correlation(ratios, noise);
  return noise;
}

}  // namespace lockbox
