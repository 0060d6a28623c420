// SPDX-License-Identifier: BSD-3-Clause
// The runs of `lockbox experiment kidnap`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "lockbox/evaluation/frame_outcome.hpp"

namespace lockbox::app {

inline constexpr int kFramesBeforeKidnap = 10;
inline constexpr int kFramesAfterKidnap = 30;

/// What happened from the first frame on that follows the event; before it are frames while the
/// camera was covered.
struct KidnapRun {
  std::string kind;
  int number = 0;
  int trusted_while_covered = 0;
  std::vector<FrameOutcome> frames;

  /// How many frames it took until the estimate was trusted, and right to the end; 0: it was not.
  int frames_to_find() const;
};

/// The box moves while the camera sees nothing for a second.
KidnapRun run_covered(const ArticulatedModel& model, int number,
                      const ExperimentSettings& settings);

/// The estimate is thrown 30 cm behind the cloud, in a recording of a still box.
KidnapRun run_thrown(const ArticulatedModel& model, const Recording& recording, int number,
                     std::uint64_t seed);

/// As run_covered(), but by the clock: 30 frames a second, the newest is taken, none waits for a
/// search.
struct LiveKidnapRun {
  int number = 0;
  std::optional<double> seconds;      ///< from the first frame in view to an estimate that is right
  std::vector<double> usual_latency;  ///< of frames before the event, milliseconds
  std::vector<double> search_latency;  ///< of frames in view until it is found
  std::vector<FrameOutcome> frames;    ///< from the first one in view
};

LiveKidnapRun run_live(const ArticulatedModel& model, int number,
                       const ExperimentSettings& settings);

}  // namespace lockbox::app
