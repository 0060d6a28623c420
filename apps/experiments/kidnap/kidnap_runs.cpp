// SPDX-License-Identifier: BSD-3-Clause
#include "kidnap_runs.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "command_line/shipped_files.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::app {
namespace {

constexpr int kFramesCovered = 30;  // a second
constexpr double kThrown = 0.3;     // metres
constexpr double kLiveRate = 30.0;  // frames a second
constexpr double kPatience = 30.0;  // seconds of a live run

Configuration moved(const Configuration& from, RandomDraws& random) {
  Configuration to = from;
  to.T_camera_base.translation() += random.uniform(0.1, 0.3) * random.direction();
  to.T_camera_base.linear() =
      Eigen::AngleAxisd(kRadians * random.uniform(5.0, 30.0), random.direction()) *
      to.T_camera_base.linear();
  return to;
}

/// The box moves while the camera sees nothing.
Recording covered_recording(const ArticulatedModel& model, std::uint64_t number,
                            const ExperimentSettings& settings) {
  RandomDraws random(settings.seed, number);
  const Configuration before = usual_view(model);
  const Configuration after = moved(before, random);
  auto truth = still_states(before, kFramesBeforeKidnap + kFramesCovered + kFramesAfterKidnap);
  for (std::size_t i = kFramesBeforeKidnap + kFramesCovered / 2; i < truth.size(); ++i) {
    truth[i].configuration = after;
  }
  ExperimentSettings silent = settings;
  silent.quiet = true;
  Recording recording = simulate(model, truth, read_scene(find_scene("room")), silent);
  for (std::size_t i = kFramesBeforeKidnap; i < kFramesBeforeKidnap + kFramesCovered; ++i) {
    std::fill(recording.frames[i].depth.begin(), recording.frames[i].depth.end(), 0);
  }
  return recording;
}

/// Throws it along the line of sight, with a random turn of up to ten degrees.
Configuration thrown_behind(Configuration configuration, RandomDraws& random) {
  Eigen::Isometry3d& pose = configuration.T_camera_base;
  pose.translation() += kThrown * pose.translation().normalized();
  pose.rotate(Eigen::AngleAxisd(kRadians * random.uniform(0.0, 10.0), random.direction()));
  return configuration;
}

/// Returns the number of the recording's frame; those after the event come again and again.
std::size_t frame_shown_at(int number) {
  constexpr int kFirstInView = kFramesBeforeKidnap + kFramesCovered;
  if (number < kFirstInView) return static_cast<std::size_t>(number);
  return static_cast<std::size_t>(kFirstInView + (number - kFirstInView) % kFramesAfterKidnap);
}

}  // namespace

int KidnapRun::frames_to_find() const {
  std::size_t first = frames.size();
  while (first > 0 && frames[first - 1].is_right()) --first;
  while (first < frames.size() && frames[first].status != TrackingStatus::tracking) ++first;
  return first < frames.size() ? static_cast<int>(first) + 1 : 0;
}

KidnapRun run_covered(const ArticulatedModel& model, int number,
                      const ExperimentSettings& settings) {
  const Recording recording =
      covered_recording(model, static_cast<std::uint64_t>(number), settings);
  Tracker tracker(model, TrackerOptions{});
  tracker.start(recording.truth.front().configuration);
  const auto results = track(tracker, recording);
  KidnapRun run{"covered", number, 0, {}};
  for (std::size_t i = kFramesBeforeKidnap; i < results.size(); ++i) {
    const FrameOutcome outcome = compare(model.tree, results[i], recording.truth[i]);
    if (i < kFramesBeforeKidnap + kFramesCovered) {
      run.trusted_while_covered += outcome.status == TrackingStatus::tracking ? 1 : 0;
    } else {
      run.frames.push_back(outcome);
    }
  }
  return run;
}

KidnapRun run_thrown(const ArticulatedModel& model, const Recording& recording, int number,
                     std::uint64_t seed) {
  RandomDraws random(seed, static_cast<std::uint64_t>(number));
  Tracker tracker(model, TrackerOptions{});
  tracker.start(recording.truth.front().configuration);
  KidnapRun run{"thrown", number, 0, {}};
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    if (i == kFramesBeforeKidnap) {
      tracker.start(thrown_behind(recording.truth[i].configuration, random));
    }
    const TrackingResult& result = tracker.process(recording.frames[i]);
    if (i >= kFramesBeforeKidnap)
      run.frames.push_back(compare(model.tree, result, recording.truth[i]));
  }
  return run;
}

LiveKidnapRun run_live(const ArticulatedModel& model, int number,
                       const ExperimentSettings& settings) {
  using Clock = std::chrono::steady_clock;
  const Recording recording =
      covered_recording(model, static_cast<std::uint64_t>(number), settings);
  TrackerOptions options;
  options.background_search = true;
  Tracker tracker(model, options);
  tracker.start(recording.truth.front().configuration);
  LiveKidnapRun run{number, std::nullopt, {}, {}, {}};
  constexpr int kFirstInView = kFramesBeforeKidnap + kFramesCovered;
  const Clock::time_point start = Clock::now();
  const auto now = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  int next = 0;
  const auto is_over = [&] {
    return run.seconds ? next >= kFirstInView + kFramesAfterKidnap : now() > kPatience;
  };
  while (!is_over()) {
    std::this_thread::sleep_until(start + std::chrono::duration<double>(next / kLiveRate));
    next = std::max(next, static_cast<int>(now() * kLiveRate));  // a camera does not wait, either
    DepthFrame frame = recording.frames[frame_shown_at(next)];
    frame.stamp = next / kLiveRate;
    const TrackingResult& result = tracker.process(frame);
    if (next >= kFirstInView) {
      run.frames.push_back(compare(model.tree, result, recording.truth.back()));
      const bool is_found =
          result.status == TrackingStatus::tracking && run.frames.back().is_right();
      if (is_found && !run.seconds) run.seconds = now() - kFirstInView / kLiveRate;
    }
    if (next < kFramesBeforeKidnap) {
      run.usual_latency.push_back(result.latency_ms);
    } else if (next >= kFirstInView && !run.seconds) {
      run.search_latency.push_back(result.latency_ms);
    }
    ++next;
  }
  return run;
}

}  // namespace lockbox::app
