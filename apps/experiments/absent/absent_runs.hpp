// SPDX-License-Identifier: BSD-3-Clause
// Where the frames of `lockbox experiment absent` come from, and what a tracker makes of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "absent_report.hpp"
#include "lockbox/core/depth_frame.hpp"
#include "lockbox/evaluation/absent_room.hpp"
#include "lockbox/evaluation/table.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox::app {

/// Frames without the object, on demand.
struct AbsentFrames {
  AbsentRun run;
  std::function<bool(DepthFrame&)> next;  ///< false at the end
};

/// A run that may have been done already.
struct PlannedAbsentRun {
  std::string text;  ///< AbsentRun::text()
  std::function<AbsentFrames()> open;
};

/// How many frames of which runs.
struct AbsentPlan {
  std::uint64_t rooms;
  std::uint64_t near_misses;
  int frames;  ///< of each of them
  SensorModel sensor;
  std::uint64_t seed;
};

/// The rooms must outlive what is returned.
std::vector<PlannedAbsentRun> simulated_runs(const AbsentRooms& rooms, const AbsentPlan& plan);

/// Returns runs of the recordings that recordings_in() names, so many frames each at most. Those of
/// a folder that cannot be read are told on standard error, and are empty; those named themselves
/// throw InputError when they are opened.
std::vector<PlannedAbsentRun> recorded_runs(const std::vector<std::string>& recordings,
                                            std::size_t most_frames);

/// Tracks the frames without a guess, and adds their rows. A signal that was noted stops its
/// searches, which then throw Stopped. Each frame in which
/// the object is claimed to be is drawn without and with it, as
/// <pictures>_<kind>_<room>_<frame>_image.png and ..._claim.png.
void track_absent(const ArticulatedModel& model, const AbsentFrames& frames,
                  const std::filesystem::path& pictures, Table& table);

}  // namespace lockbox::app
