// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "command.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/tracking/tracker.hpp"
#include "run_description.hpp"

namespace lockbox::app {

/// Where the results of a run go, and when it ends.
struct RunSettings {
  std::filesystem::path output;     ///< folder; empty: nothing is written
  bool covariance = false;          ///< write covariance.csv too
  std::filesystem::path recording;  ///< .oni file that receives the frames; empty: none
  std::filesystem::path snapshots;  ///< folder of pictures; empty: none
  std::size_t snapshot_interval = 10;
  std::size_t max_frames = 0;  ///< 0: until the source ends
  bool view = false;           ///< show every frame in a window
  bool quiet = false;
};

/// Tracks all frames of the source, until its end, the frame limit, or Ctrl-C; then the files are
/// complete. The camera of the description is filled in from the first frame.
ExitStatus track_source(FrameSource& source, Tracker& tracker, const ArticulatedModel& model,
                        RunDescription description, const RunSettings& settings);

}  // namespace lockbox::app
