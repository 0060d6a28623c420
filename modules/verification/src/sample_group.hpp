// SPDX-License-Identifier: BSD-3-Clause
// What a few neighbouring pixels say together of a body: flat and round parts are explained nearly
// everywhere where they are not.
#pragma once

#include <algorithm>
#include <cmath>

#include "lockbox/cloud/thinned_points.hpp"
#include "lockbox/verification/agreement.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/view_samples.hpp"

namespace lockbox {

/// Adds pixels that are explained, measured so far behind the surface (metres).
inline void count_explained(double pixels, double behind, double sigma, Agreement& counts) {
  counts.explained += pixels;
  if (behind > sigma) counts.recedes += pixels;
  if (behind < -sigma) counts.recedes -= pixels;
}

/// Neighbouring samples of one body, which speak together. They must come group by group.
class SampleGroup {
 public:
  /// reduction: pixels of the camera along one of the view.
  SampleGroup(const ViewOptions& options, int reduction, Agreement& counts)
      : options_(options), least_pixels_(0.5 * std::pow(kSize * reduction, 2)), counts_(counts) {}

  /// A sample near which something was measured: so far behind it, metres.
  void explain(const ViewSample& sample, double behind, double sigma) {
    add(sample, behind, sigma);
    count_explained(sample.pixels, behind, sigma, explained_);
  }
  /// A sample through which the camera sees.
  void contradict(const ViewSample& sample, double behind, double sigma) {
    add(sample, behind, sigma);
    counts_.contradicted += sample.pixels;
  }
  /// Counts the group in hand. What lies behind as a whole explains nothing.
  void close() {
    if (lies_behind()) {
      counts_.contradicted += explained_.explained;
      counts_.groups_behind += pixels_;
    } else {
      counts_.explained += explained_.explained;
      counts_.recedes += explained_.recedes;
    }
    explained_ = {};
    pixels_ = 0.0;
    samples_ = 0.0;
    sum_behind_ = 0.0;
    sum_variance_ = 0.0;
  }

 private:
  /// The mean over a group that lies behind exceeds this, metres: so inexact are models and
  /// cameras. Doubled, flat parts may lie 1 cm before what they are taken for.
  static constexpr double kMeanMayRecede = 0.005;
  /// Beyond that, in standard deviations of the mean: of hundreds of groups none should be wrong.
  /// Doubled, groups of few pixels contradict nothing.
  static constexpr double kMeanSigmas = 4.5;
  static constexpr int kSize = SamplingDensity::kCellSize;  // pixels of the view

  bool lies_behind() const {
    if (pixels_ < least_pixels_) return false;
    // Neighbours err alike, and samples that stand for many pixels are no more than they are.
    const double independent = std::min(pixels_ / options_.noise_correlation, samples_);
    const double sigma_of_mean = std::sqrt(sum_variance_ / pixels_ / independent);
    return sum_behind_ > (kMeanMayRecede + kMeanSigmas * sigma_of_mean) * pixels_;
  }

  void add(const ViewSample& sample, double behind, double sigma) {
    const Pixel place{sample.pixel.u / kSize, sample.pixel.v / kSize};
    if (place.u != place_.u || place.v != place_.v) close();
    place_ = place;
    // How far, of what is too far, does not matter: a few see past an edge to the wall.
    const double most = 2.0 * kMeanMayRecede + options_.gate * sigma;
    pixels_ += sample.pixels;
    samples_ += 1.0;
    sum_variance_ += sample.pixels * sigma * sigma;
    sum_behind_ += sample.pixels * std::clamp(behind, -most, most);
  }

  const ViewOptions& options_;
  double least_pixels_;  ///< strips along an edge are too few
  Agreement& counts_;
  Agreement explained_;
  Pixel place_{-1, -1};
  double pixels_ = 0.0;
  double samples_ = 0.0;
  double sum_behind_ = 0.0;    ///< metres, over pixels
  double sum_variance_ = 0.0;  ///< the same, metres^2
};

}  // namespace lockbox
