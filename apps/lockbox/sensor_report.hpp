// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/sensor/sensor_noise.hpp"
#include "lockbox/tracking/tracker.hpp"

namespace lockbox::app {

/// Says on standard error, once, how the sensor errs, where the tracker has found it out.
class SensorReport {
 public:
  /// tracker: before the first frame. quiet: says nothing.
  SensorReport(const Tracker& tracker, bool quiet);

  /// Looks at it after each frame.
  void look_at(const Tracker& tracker);

 private:
  SensorNoise assumed_;
  bool is_said_;
};

}  // namespace lockbox::app
