// SPDX-License-Identifier: BSD-3-Clause
#include "followed_noise.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lockbox {
namespace {

/// Factors. What differs less changes nothing: to assume another noise costs an alignment its
/// memory. Doubled, residuals leave what is right (0.8 to 1.25) before it is noticed.
constexpr double kSameSigma = 1.1;
constexpr double kSameArea = 1.5;
/// Frames, a third of a second: those of a source that starts may be empty. Doubled, each frame of
/// a camera that shows nothing takes longer for twice the time.
constexpr int kLooksAtStart = 10;

bool differs(double a, double b, double factor) {
  return std::abs(std::log(a / b)) > std::log(factor);
}

bool is_other(const SensorNoise& noise, const SensorNoise& assumed,
              const std::vector<double>& depths) {
  const auto has_other_sigma = [&](double z) {
    return differs(noise.sigma_z(z), assumed.sigma_z(z), kSameSigma);
  };
  return std::any_of(depths.begin(), depths.end(), has_other_sigma) ||
         differs(noise.correlation_area(), assumed.correlation_area(), kSameArea);
}

}  // namespace

std::optional<SensorNoise> FollowedNoise::changed_by(const DepthFrame& frame,
                                                     const SensorNoise& assumed) {
  if (parts_ == 0) return std::nullopt;
  if (is_told_ || whole_looks_ == kLooksAtStart) {
    record_.look_at_part(frame, part_, parts_);
    part_ = (part_ + 1) % parts_;
    if (part_ != 0) return std::nullopt;
  } else {
    record_.look_at(frame);
    ++whole_looks_;
  }
  const auto noise = record_.noise();
  is_told_ |= noise.has_value();
  return noise && is_other(*noise, assumed, record_.depths()) ? noise : std::nullopt;
}

}  // namespace lockbox
