// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/sensor/noise_record.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// The noise of a sensor of which nothing is known, or whose distance, or what it looks at, changes
/// during a run.
class FollowedNoise {
 public:
  /// pause: frames from one that is looked at to the next; 0: none is.
  explicit FollowedNoise(int pause) : pause_(pause) {}

  /// The noise, where it is another one than what is assumed.
  std::optional<SensorNoise> changed_by(const DepthFrame& frame, const SensorNoise& assumed);

 private:
  int pause_;
  int frames_to_next_ = 0;
  int looks_ = 0;
  NoiseRecord record_;
};

}  // namespace lockbox
