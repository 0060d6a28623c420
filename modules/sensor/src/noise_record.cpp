// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sensor/noise_record.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "depth_bins.hpp"
#include "depth_steps.hpp"
#include "lockbox/core/square.hpp"
#include "noise_fit.hpp"

namespace lockbox {
namespace {

using Bin = NoiseRecord::Bin;
using Seen = NoiseRecord::Seen;

constexpr int kRowsApart = 3;          // at least: neighbouring rows err alike
constexpr int kRows = 80;              // as many tell enough
constexpr std::size_t kShortLags = 2;  // at which errors are too much alike to tell their size
constexpr std::size_t kEnough = 300;   // differences, for an image to tell of a bin
/// What counts of the images before, beside one more. Doubled (all), a change of the scene is never
/// followed; halved, every image is taken by itself.
constexpr double kKept = 0.5;

double quantile(std::vector<double>& sizes, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size()));
  std::nth_element(sizes.begin(), sizes.begin() + rank, sizes.end());
  return sizes[static_cast<std::size_t>(rank)];
}

/// Returns the deviation of what is normal but for outliers: what lies beyond 2.5 deviations does
/// not count, again and again. Values are discrete where a sensor rounds: their median would be,
/// too.
double core_deviation(std::vector<double>& sizes) {
  constexpr int kRounds = 12;
  constexpr double kCut = 2.5;
  constexpr double kWithin = 0.9112;  // variance of a normal distribution cut off there
  constexpr double kSame = 1e-3;      // a hundredth of what a noise may differ by unnoticed
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
    const double before = std::exchange(deviation, std::sqrt(squares / count / kWithin));
    if (std::abs(deviation - before) < kSame * deviation) break;
  }
  return deviation;
}

/// A row of the image.
struct Row {
  std::vector<double> inverse;                   ///< 1/z; 0 where nothing was measured
  std::vector<std::optional<std::size_t>> bins;  ///< of the depths
};

void read_row(const DepthFrame& frame, int v, Row& row) {
  const auto width = static_cast<std::size_t>(frame.camera.width);
  row.inverse.assign(width, 0.0);
  row.bins.assign(width, std::nullopt);
  for (std::size_t u = 0; u < width; ++u) {
    const double z = frame.metres(static_cast<int>(u), v);
    if (z > 0.0) row.inverse[u] = 1.0 / z;
    row.bins[u] = depth_bin(z);
  }
}

void add_differences(const Row& row, std::size_t lag, std::array<Seen, NoiseRecord::kBins>& seen) {
  for (std::size_t u = lag; u + lag < row.inverse.size(); ++u) {
    const double left = row.inverse[u - lag];
    const double right = row.inverse[u + lag];
    if (!row.bins[u] || left == 0.0 || right == 0.0) continue;
    const double z = 1.0 / row.inverse[u];
    Seen& bin = seen[*row.bins[u]];
    bin.sizes.push_back(z * z * std::abs(left - 2.0 * row.inverse[u] + right));
    bin.depths += z;
  }
}

/// Adds the differences of the rows of that part.
void add_differences(const DepthFrame& frame, int part, int parts, NoiseRecord::SeenAtLags& seen) {
  Row row;
  const int step = std::max(kRowsApart, frame.camera.height / kRows);
  for (int v = part * step; v < frame.camera.height; v += parts * step) {
    read_row(frame, v, row);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      add_differences(row, static_cast<std::size_t>(NoiseRecord::kLags[k]), seen[k]);
    }
  }
}

/// least: what a difference of depths with such steps scatters by at least.
Bin bin_from(Seen& seen, double least) {
  const auto count = static_cast<double>(seen.sizes.size());
  return {count, seen.depths / count, square(std::max(least, core_deviation(seen.sizes)))};
}

/// Returns the deviation of second differences of what is rounded to steps of that length. Where
/// the steps are wide most of a wall is one depth, and most of its differences are none.
double deviation_by_steps(double step) {
  return step * std::sqrt(kDifferenceVariance / 12.0);
}

/// Returns the bins without what bends add. half, twice: the same at half and at twice the lag;
/// where that was not seen nothing is left out. Where most would be, steps are seen rather than
/// bends: not at this lag yet, if it shows no more than half of it, or else it tells nothing.
NoiseRecord::Bins without_bends(const NoiseRecord::Bins& bins, const NoiseRecord::Bins& half,
                                const NoiseRecord::Bins& twice) {
  // Unit: a share of the variance. Source: 0.6 to 0.8 is left of planes and round things on a real
  // desk, a tenth beside the steps of an SR300's room. Doubled, nothing that bends tells.
  constexpr double kLeastLeft = 0.5;
  // Unit: a factor of the variance. Source: white noise has 1; what is alike over three pixels 1.7
  // from four to eight of them. Doubled, steps pass for noise.
  constexpr double kNoMore = 1.2;
  NoiseRecord::Bins straight = bins;
  for (std::size_t b = 0; b < straight.size(); ++b) {
    if (!(twice[b].count > 0.0)) continue;
    const double left = (16.0 * bins[b].variance - twice[b].variance) / 15.0;
    const bool is_noise = half[b].count > 0.0 && bins[b].variance <= kNoMore * half[b].variance;
    if (left >= kLeastLeft * bins[b].variance) {
      straight[b].variance = left;
    } else if (!is_noise) {
      straight[b].count = 0.0;
    }
  }
  return straight;
}

/// Errors are no more alike at a longer lag.
void keep_growth(const NoiseRecord::Bins& shorter, NoiseRecord::Bins& longer) {
  for (std::size_t b = 0; b < longer.size(); ++b) {
    if (shorter[b].count > 0.0) {
      longer[b].variance = std::max(longer[b].variance, shorter[b].variance);
    }
  }
}

/// Rounding makes steps along faces: it is alike there, however little neighbours seem to be.
void assume_usual_correlation(SensorNoise& noise) {
  noise.own_share = SensorNoise{}.own_share;
  noise.correlation_pixels = SensorNoise{}.correlation_pixels;
}

void add(const Bin& more, Bin& bin) {
  const double count = bin.count + more.count;
  bin.depth += (more.depth - bin.depth) * more.count / count;
  bin.variance += (more.variance - bin.variance) * more.count / count;
  bin.count = count;
}

}  // namespace

void NoiseRecord::look_at_part(const DepthFrame& frame, int part, int parts) {
  add_differences(frame, part, parts, seen_);
  if (part + 1 == parts) conclude(frame);
}

void NoiseRecord::conclude(const DepthFrame& last) {
  rounding_ = static_cast<double>(last.metres_per_unit);
  const auto steps = depth_steps(last);
  for (std::size_t k = 0; k < kLags.size(); ++k) {
    for (std::size_t b = 0; b < kBins; ++b) {
      Seen& seen = seen_[k][b];
      bins_[k][b].count *= kKept;
      if (seen.sizes.size() >= kEnough) {
        // Neighbours are rounded alike.
        const double least = k < kShortLags ? 0.0 : deviation_by_steps(steps[b]);
        add(bin_from(seen, least), bins_[k][b]);
      }
      seen.sizes.clear();
      seen.depths = 0.0;
    }
  }
}

std::optional<SensorNoise> NoiseRecord::noise() const {
  SensorNoise noise;
  // Of small things few faces are as wide as two of the longest lags.
  for (std::size_t k = kLags.size() - 1; k-- > kShortLags;) {
    std::array<Bins, kLags.size() - 1> straight;
    for (std::size_t j = 0; j <= k; ++j) {
      straight[j] = without_bends(bins_[j], j > 0 ? bins_[j - 1] : Bins{}, bins_[j + 1]);
      if (j > 0) keep_growth(straight[j - 1], straight[j]);
    }
    if (!fit_noise(std::span(straight).first(k + 1), rounding_, noise)) continue;
    if (is_rounding(noise)) assume_usual_correlation(noise);
    return noise;
  }
  return std::nullopt;
}

/// Wherever something was seen.
bool NoiseRecord::is_rounding(const SensorNoise& noise) const {
  // A factor of what rounding errs by. Source: images without noise have 1 to 1.2. Doubled, a good
  // time-of-flight camera's errors are taken to be alike.
  constexpr double kMostly = 1.5;
  const std::vector<double> seen = depths();
  return std::all_of(seen.begin(), seen.end(), [&](double z) {
    return noise.sigma_z(z) < kMostly * rounding_ / std::sqrt(12.0);
  });
}

std::vector<double> NoiseRecord::depths() const {
  std::vector<double> depths;
  for (const Bin& bin : bins_[kShortLags]) {
    if (bin.count >= static_cast<double>(kEnough)) depths.push_back(bin.depth);
  }
  return depths;
}

std::optional<SensorNoise> estimate_noise(const DepthFrame& frame) {
  NoiseRecord record;
  record.look_at(frame);
  return record.noise();
}

}  // namespace lockbox
