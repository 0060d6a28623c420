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
  /// parts: frames that share the work of a look, once one has told the noise; 0: none is looked
  /// at.
  explicit FollowedNoise(int parts) : parts_(parts) {}

  /// The noise, where it is another one than what is assumed.
  std::optional<SensorNoise> changed_by(const DepthFrame& frame, const SensorNoise& assumed);

 private:
  int parts_;
  int part_ = 0;
  int whole_looks_ = 0;
  bool is_told_ = false;
  NoiseRecord record_;
};

}  // namespace lockbox
