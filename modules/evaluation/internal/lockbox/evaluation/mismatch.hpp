// SPDX-License-Identifier: BSD-3-Clause
// Tracking an object that is not its model, with a camera that is not its calibration.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/deviation.hpp"
#include "lockbox/simulation/scene.hpp"
#include "lockbox/simulation/sensor_model.hpp"
#include "lockbox/tracking/tracker_options.hpp"

namespace lockbox {

/// One frame against the truth, which is the pose that the calibration shows (Simulator::
/// apparent_base). Joints are compared as they are.
struct MismatchFrame {
  FrameOutcome outcome;
  /// Base and determined joints within the tolerances, and no joint determined whose part is
  /// missing.
  bool is_right = false;
  double plain_translation = 0.0;  ///< error of the base against where it truly is, metres
  double plain_rotation = 0.0;     ///< radians
  /// Largest of the base's six errors, and of the determined joints', as multiples of the reported
  /// sigma; NaN while nothing is known, 0 without such joints.
  double base_in_sigmas = 0.0;
  double joint_in_sigmas = 0.0;
};

struct MismatchSettings {
  PinholeCamera camera;  ///< the calibration
  SensorModel sensor;
  Scene scene;
  std::uint64_t seed = 1;  ///< of the sensor's noise
  TrackerOptions tracker;
};

/// Simulates the run with the deviation and tracks it without a guess: the tracker gets the model
/// and the calibration. One entry a frame that arrives. Throws Stopped if it was stopped.
std::vector<MismatchFrame> track_mismatch(const ArticulatedModel& model,
                                          const std::vector<State>& run, const Deviation& deviation,
                                          const MismatchSettings& settings,
                                          const Executor& executor);

}  // namespace lockbox
