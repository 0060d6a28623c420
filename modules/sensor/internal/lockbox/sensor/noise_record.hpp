// SPDX-License-Identifier: BSD-3-Clause
// How a sensor errs, from its images.
//
// Along a row 1/z is linear on any plane. So its second differences at a distance of k pixels,
//
//   D_k(u) = d(u - k) - 2 d(u) + d(u + k),   d = 1/z,
//
// are noise on planes, which most of an image shows; the rest (edges, curved faces) are outliers.
// Of errors that correlate by rho, var D_k = s^2 (6 - 8 rho(k) + 2 rho(2 k)): large k tell s, and
// how it grows with k tells how alike neighbours err. What bends adds to it, as k^4: that is left
// out of (16 var D_k - var D_2k) / 15. Not seen is what is alike over more than a dozen pixels, and
// what a whole face is off: that takes a profile.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// What images have told of the noise, depth by depth. Later ones count more; a depth that is not
/// seen any more is forgotten slowly.
class NoiseRecord {
 public:
  /// Takes about as long as a frame. What comes of it depends on nothing but the images.
  void look_at(const DepthFrame& frame) { look_at_part(frame, 0, 1); }

  /// Looks at a frame in parts, 0 <= part < parts, of which each takes the rows of another image:
  /// no frame takes much longer than others. What they show together counts with the last one.
  void look_at_part(const DepthFrame& frame, int part, int parts);

  /// The noise along the ray and how it correlates; across the ray as SensorNoise has it. None if
  /// the images show too little.
  std::optional<SensorNoise> noise() const;

  /// Metres, at which noise() is what images have shown, the nearest first: the bins of depths of
  /// which each has told enough.
  std::vector<double> depths() const;

  static constexpr std::array kLags{1, 2, 4, 8, 16};  ///< pixels
  static constexpr std::size_t kBins = 16;            ///< of depths

  /// Second differences at depths that are much the same, times z^2: metres along the ray.
  struct Bin {
    double count = 0.0;     ///< differences; of earlier images only a part
    double depth = 0.0;     ///< metres, their mean
    double variance = 0.0;  ///< of a difference
  };
  using Bins = std::array<Bin, kBins>;

  /// Second differences of which nothing was concluded yet.
  struct Seen {
    std::vector<double> sizes;
    double depths = 0.0;  ///< their sum
  };
  using SeenAtLags = std::array<std::array<Seen, kBins>, kLags.size()>;

 private:
  void conclude(const DepthFrame& last);
  bool is_rounding(const SensorNoise& noise) const;

  SeenAtLags seen_;
  std::array<Bins, kLags.size()> bins_{};
  double rounding_ = 0.0;  ///< metres, the unit of the depths
};

/// The noise of one image: NoiseRecord's.
std::optional<SensorNoise> estimate_noise(const DepthFrame& frame);

}  // namespace lockbox
