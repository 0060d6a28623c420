// SPDX-License-Identifier: BSD-3-Clause
#include "peer_runs.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/lie.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::app {
namespace {

constexpr double kFrameTime = 1.0 / 30.0;  // seconds

TrackerOptions on_one_thread(std::size_t point_budget, bool searches) {
  TrackerOptions options;
  options.registration.point_budget = point_budget;
  options.threads = 1;
  options.search_anywhere = searches;
  return options;
}

double joint_error(const KinematicTree& tree, const Configuration& estimate,
                   const Configuration& truth, const char* joint) {
  const int index = joint_index(tree, joint);
  return std::abs(joint_position(tree, estimate, index) - joint_position(tree, truth, index));
}

PeerFrame compare_with(const KinematicTree& tree, const State& truth,
                       const TrackingResult& result) {
  PeerFrame frame;
  const Configuration& exact = truth.configuration;
  frame.outcome = compare(tree, result, truth);
  frame.offset =
      exact.T_camera_base.linear().transpose() *
      (result.configuration.T_camera_base.translation() - exact.T_camera_base.translation());
  frame.door = joint_error(tree, result.configuration, exact, "door");
  frame.slide = joint_error(tree, result.configuration, exact, "slide");
  frame.cloud_time = result.cloud_time;
  frame.step_time = result.step_time;
  return frame;
}

double turn_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return log_so3(a.linear().transpose() * b.linear()).norm();
}

Configuration displaced(const KinematicTree& tree, const Configuration& truth,
                        const CaptureKind& kind, int number, std::uint64_t seed) {
  RandomDraws random(seed, static_cast<std::uint64_t>(number));
  Configuration start = truth;
  Eigen::Isometry3d& pose = start.T_camera_base;
  pose.translation() += kind.translation * random.direction();
  pose.linear() = Eigen::AngleAxisd(kind.rotation, random.direction()) * pose.linear();
  const double sign = number % 2 == 0 ? 1.0 : -1.0;
  const auto move = [&](const char* joint, double by) {
    const double position = joint_position(tree, truth, joint_index(tree, joint));
    set_joint_position(tree, start, joint, position + sign * by);
  };
  move("door", kind.door);
  move("slide", kind.slide);
  return start;
}

}  // namespace

bool PeerFrame::is_right() const {
  const Tolerances tolerances;
  return outcome.is_right(tolerances) && door <= tolerances.turning && slide <= tolerances.sliding;
}

const std::vector<PeerSetting>& peer_settings() {
  static const std::vector<PeerSetting> settings = {
      {"lockbox", RegistrationOptions{}.point_budget},
      {"lockbox fast", 600},  // as many as M3T fast reads
  };
  return settings;
}

PeerRun follow_sequence(const ArticulatedModel& model, const PeerSetting& setting,
                        const std::string& sequence, int every, std::uint64_t seed,
                        const Recording& recording) {
  PeerRun run{setting.name, sequence, every, seed, 0.0, 0.0, {}};
  Tracker tracker(model, on_one_thread(setting.point_budget, true));
  tracker.start(recording.truth.front().configuration);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const State& truth = recording.truth[i];
    run.frames.push_back(compare_with(model.tree, truth, tracker.process(recording.frames[i])));
    if (i == 0) continue;
    const Eigen::Isometry3d& last = recording.truth[i - 1].configuration.T_camera_base;
    const Eigen::Isometry3d& next = truth.configuration.T_camera_base;
    run.largest_step = std::max(run.largest_step, (next.translation() - last.translation()).norm());
    run.largest_turn = std::max(run.largest_turn, turn_between(last, next));
  }
  return run;
}

const std::vector<CaptureKind>& capture_kinds() {
  static const std::vector<CaptureKind> kinds = {
      {"8 cm", 0.08, 0.0, 0.0, 0.0},
      {"15 degrees", 0.0, 15.0 * kRadians, 0.0, 0.0},
      {"10 degrees and 6.7 cm", 0.067, 10.0 * kRadians, 0.0, 0.0},
      {"door 20 degrees", 0.0, 0.0, 20.0 * kRadians, 0.0},
      {"slide 8 cm", 0.0, 0.0, 0.0, 0.08},
  };
  return kinds;
}

bool CaptureTrial::succeeds() const {
  return end.outcome.translation < 0.02 && end.outcome.rotation < 3.0 * kRadians &&
         end.door < 5.0 * kRadians && end.slide < 0.02;
}

CaptureTrial capture(const ArticulatedModel& model, const CaptureKind& kind, int number,
                     std::uint64_t seed, bool searches, const State& truth,
                     const DepthFrame& frame) {
  CaptureTrial trial{kind.name, number, searches, {}};
  Tracker tracker(model, on_one_thread(peer_settings().front().point_budget, searches));
  tracker.start(displaced(model.tree, truth.configuration, kind, number, seed));
  DepthFrame repeated = frame;
  for (int step = 0; step < kCaptureSteps; ++step) {
    repeated.stamp = frame.stamp + step * kFrameTime;
    trial.end = compare_with(model.tree, truth, tracker.process(repeated));
  }
  return trial;
}

}  // namespace lockbox::app
