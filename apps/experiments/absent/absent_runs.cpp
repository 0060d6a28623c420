// SPDX-License-Identifier: BSD-3-Clause
#include "absent_runs.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include "command_line/interruption.hpp"
#include "lockbox/capture/frame_source.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/visualization/depth_picture.hpp"
#include "lockbox/visualization/model_painter.hpp"
#include "recordings.hpp"

namespace lockbox::app {
namespace {

/// A simulated room with what draws it. It stays where it is, since the simulator refers to it.
struct SimulatedRoom {
  SimulatedRoom(AbsentRoom drawn, const SensorModel& sensor, std::uint64_t seed)
      : room(std::move(drawn)),
        simulator(room.tree, sensor.camera, PlacedScene(room.scene, room.run), sensor, seed,
                  interruption::executor()) {}

  AbsentRoom room;
  Simulator simulator;
  std::size_t next = 0;
};

std::string run_text(AbsentKind kind, std::uint64_t number) {
  return AbsentRun{to_string(kind), std::to_string(number), {}}.text();
}

AbsentFrames frames_of(AbsentRoom drawn, std::uint64_t number, const AbsentPlan& plan) {
  const AbsentRun run{to_string(drawn.kind), std::to_string(number), drawn.content};
  const auto room =
      std::make_shared<SimulatedRoom>(std::move(drawn), plan.sensor, plan.seed + number);
  return {run, [room](DepthFrame& frame) {
            if (room->next == room->room.run.size()) return false;
            room->simulator.simulate(room->room.run[room->next], room->next, frame);
            ++room->next;
            return true;
          }};
}

/// A word for a table, and for a part of a file's name.
std::string as_word(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '/' || c == '\n'; }, '_');
  return text;
}

AbsentFrames frames_of_recording(const std::string& recording, std::size_t most, bool is_listed) {
  SourceOptions options;
  options.warn = [](const std::string& text) { std::cerr << "lockbox: warning: " << text << '\n'; };
  const std::string name = std::filesystem::path(recording).filename().string();
  const AbsentRun run{kRecordedRoom, as_word(recording), as_word(name)};
  try {
    const std::shared_ptr<FrameSource> source = open_source(recording, options);
    return {run, [source, most, taken = std::size_t{0}](DepthFrame& frame) mutable {
              return taken++ < most && source->next(frame);
            }};
  } catch (const InputError& error) {
    if (!is_listed) throw;
    std::cerr << "lockbox: warning: left out: " << error.what() << '\n';
    return {run, [](DepthFrame&) { return false; }};
  }
}

void write_claim(const ArticulatedModel& model, const DepthFrame& frame,
                 const Configuration& claimed, const std::string& stem) {
  constexpr float kOpacity = 0.5F;
  RgbImage picture = depth_picture(frame);
  write_png(stem + "_image.png", picture);
  ModelPainter(model.tree, frame.camera, Executor(), GreyModel::in_orange)
      .paint(claimed, kOpacity, picture);
  write_png(stem + "_claim.png", picture);
}

}  // namespace

std::vector<PlannedAbsentRun> simulated_runs(const AbsentRooms& rooms, const AbsentPlan& plan) {
  std::vector<PlannedAbsentRun> runs;
  for (std::uint64_t number = 0; number < plan.rooms; ++number) {
    runs.push_back({run_text(rooms.kind_of_room(number), number), [&rooms, plan, number] {
                      return frames_of(rooms.room(number, plan.frames), number, plan);
                    }});
  }
  for (std::uint64_t number = 0; number < plan.near_misses; ++number) {
    runs.push_back({run_text(rooms.kind_of_near_miss(number), number), [&rooms, plan, number] {
                      return frames_of(rooms.near_miss(number, plan.frames), number, plan);
                    }});
  }
  return runs;
}

std::vector<PlannedAbsentRun> recorded_runs(const std::vector<std::string>& names,
                                            std::size_t most_frames) {
  std::vector<PlannedAbsentRun> runs;
  for (const std::string& name : names) {
    for (const std::string& recording : recordings_in(name)) {
      runs.push_back({AbsentRun{kRecordedRoom, as_word(recording), {}}.text(),
                      [recording, most_frames, is_listed = recording != name] {
                        return frames_of_recording(recording, most_frames, is_listed);
                      }});
    }
  }
  return runs;
}

void track_absent(const ArticulatedModel& model, const AbsentFrames& frames,
                  const std::filesystem::path& pictures, Table& table) {
  TrackerOptions options;
  options.stop_request = interruption::requested;
  Tracker tracker(model, options);
  DepthFrame frame;
  for (std::size_t i = 0; frames.next(frame); ++i) {
    const TrackingResult& result = tracker.process(frame);
    add_absent_row(table, frames.run, i, result);
    if (result.status != TrackingStatus::tracking) continue;
    write_claim(model, frame, result.configuration,
                pictures.string() + "_" + frames.run.text() + "_" + std::to_string(i));
  }
}

}  // namespace lockbox::app
