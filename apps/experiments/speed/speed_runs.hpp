// SPDX-License-Identifier: BSD-3-Clause
// The runs of `lockbox experiment speed`, and what they say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lockbox/evaluation/figure.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/evaluation/recording.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox::app {

/// One motion, so many times as fast as the slowest.
struct SpeedRun {
  int factor = 1;
  double base_speed = 0.0;     ///< largest from frame to frame, metres a second
  double turning_speed = 0.0;  ///< of any joint that turns, radians a second
  double sliding_speed = 0.0;  ///< of any joint that slides, metres a second
  std::vector<FrameOutcome> frames;

  std::size_t frames_right() const;

  /// Returns whether at least 98 % of the frames are right, without searching.
  bool holds() const;
};

enum class StepKind {
  base,  ///< 8 cm and 10 degrees
  hinge  ///< 20 degrees of a hinge on the base
};

struct StepRun {
  StepKind kind = StepKind::base;
  int number = 0;
  std::string joint;                 ///< that stepped, if one did
  std::vector<FrameOutcome> frames;  ///< from the first after the step

  /// Frames until the error stays at noise level; 0 if it does not.
  int frames_to_noise_level() const;

  /// Returns whether it was found within five frames, without searching.
  bool is_in_time() const;
};

/// All joints through their ranges in `frames / factor` frames.
std::vector<State> faster_motion(const ArticulatedModel& model, const Configuration& view,
                                 int factor, int frames);

/// Ten still frames, and ten after the step. Empty if the model has no such hinge.
std::vector<State> stepped_states(const ArticulatedModel& model, const Configuration& view,
                                  StepKind kind, std::uint64_t seed, int number);

SpeedRun follow_motion(const ArticulatedModel& model, int factor, const Recording& recording);
StepRun follow_step(const ArticulatedModel& model, StepKind kind, int number,
                    const Recording& recording);

Table speed_rows(const std::vector<SpeedRun>& runs);
Table step_rows(const std::vector<StepRun>& runs);
void print_speed(const std::vector<SpeedRun>& runs, const std::vector<StepRun>& steps);
Figure speed_figure(const std::string& name, const std::vector<SpeedRun>& runs,
                    const std::vector<StepRun>& steps);

}  // namespace lockbox::app
