// SPDX-License-Identifier: BSD-3-Clause
#include "speed_runs.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/experiment.hpp"
#include "lockbox/core/units.hpp"
#include "lockbox/evaluation/possible_motion.hpp"
#include "lockbox/simulation/random_draws.hpp"

namespace lockbox::app {
namespace {

constexpr double kRate = 30.0;  // frames a second
constexpr double kRightShare = 0.98;
constexpr std::size_t kStillFrames = 10;
constexpr int kFramesAfterStep = 10;
constexpr int kAllowedFrames = 5;
constexpr double kBaseStep = 0.08;  // metres
constexpr double kBaseTurn = 10.0 * kRadians;
constexpr double kHingeStep = 20.0 * kRadians;

std::vector<FrameOutcome> outcomes(const ArticulatedModel& model, const Recording& recording) {
  Tracker tracker(model, TrackerOptions{});
  tracker.start(recording.truth.front().configuration);
  std::vector<FrameOutcome> frames;
  const auto results = track(tracker, recording);
  for (std::size_t i = 0; i < results.size(); ++i) {
    frames.push_back(compare(model.tree, results[i], recording.truth[i]));
  }
  return frames;
}

/// Hinges on the base that can make the step either way from somewhere.
std::vector<int> hinges(const KinematicTree& tree) {
  std::vector<int> found;
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const Joint& joint = tree.joints[j];
    if (joint.type == JointType::revolute && joint.parent_body == 0 && !joint.is_mimic &&
        joint.upper - joint.lower > 2.0 * kHingeStep) {
      found.push_back(static_cast<int>(j));
    }
  }
  return found;
}

void step_base(Configuration& configuration, RandomDraws& random) {
  Eigen::Isometry3d& pose = configuration.T_camera_base;
  pose.translation() += kBaseStep * random.direction();
  pose.linear() = Eigen::AngleAxisd(kBaseTurn, random.direction()) * pose.linear();
}

}  // namespace

std::size_t SpeedRun::frames_right() const {
  return static_cast<std::size_t>(
      std::count_if(frames.begin(), frames.end(), [](auto& frame) { return frame.is_right(); }));
}

bool SpeedRun::holds() const {
  return static_cast<double>(frames_right()) >= kRightShare * static_cast<double>(frames.size()) &&
         frames.back().searches == 0;
}

int StepRun::frames_to_noise_level() const {
  std::size_t first = frames.size();
  while (first > 0 && frames[first - 1].is_at_noise_level()) --first;
  return first < frames.size() ? static_cast<int>(first) + 1 : 0;
}

bool StepRun::is_in_time() const {
  const int needed = frames_to_noise_level();
  return needed > 0 && needed <= kAllowedFrames && frames.back().searches == 0;
}

std::vector<State> faster_motion(const ArticulatedModel& model, const Configuration& view,
                                 int factor, int frames) {
  TrajectoryOptions options;
  options.frames = std::max(2, frames / factor);
  options.rate = kRate / factor;
  options.T_camera_base = view.T_camera_base;
  auto states = possible_motion(model, options);
  for (State& state : states) state.stamp /= factor;
  return states;
}

std::vector<State> stepped_states(const ArticulatedModel& model, const Configuration& view,
                                  StepKind kind, std::uint64_t seed, int number) {
  RandomDraws random(seed, static_cast<std::uint64_t>(number));
  Configuration before = view;
  Configuration after = view;
  if (kind == StepKind::base) {
    step_base(after, random);
  } else {
    const auto choices = hinges(model.tree);
    if (choices.empty()) return {};
    const auto choice = static_cast<std::size_t>(number) % choices.size();
    const Joint& hinge = model.tree.joints[static_cast<std::size_t>(choices[choice])];
    before.q[hinge.variable] = random.uniform(hinge.lower + kHingeStep, hinge.upper - kHingeStep);
    after.q[hinge.variable] =
        before.q[hinge.variable] + (random.chance(0.5) ? kHingeStep : -kHingeStep);
  }
  auto states = still_states(before, static_cast<int>(kStillFrames) + kFramesAfterStep);
  for (std::size_t i = kStillFrames; i < states.size(); ++i) states[i].configuration = after;
  return states;
}

SpeedRun follow_motion(const ArticulatedModel& model, int factor, const Recording& recording) {
  SpeedRun run{factor, 0.0, 0.0, 0.0, outcomes(model, recording)};
  for (std::size_t i = 1; i < recording.truth.size(); ++i) {
    const Configuration& last = recording.truth[i - 1].configuration;
    const Configuration& next = recording.truth[i].configuration;
    run.base_speed = std::max(
        run.base_speed,
        kRate * (next.T_camera_base.translation() - last.T_camera_base.translation()).norm());
    for (std::size_t j = 0; j < model.tree.joints.size(); ++j) {
      const int joint = static_cast<int>(j);
      double& fastest =
          model.tree.joints[j].type == JointType::prismatic ? run.sliding_speed : run.turning_speed;
      fastest = std::max(fastest, kRate * std::abs(joint_position(model.tree, next, joint) -
                                                   joint_position(model.tree, last, joint)));
    }
  }
  return run;
}

StepRun follow_step(const ArticulatedModel& model, StepKind kind, int number,
                    const Recording& recording) {
  StepRun run{kind, number, "", outcomes(model, recording)};
  run.frames.erase(run.frames.begin(), run.frames.begin() + kStillFrames);
  if (kind == StepKind::hinge) {
    Eigen::Index variable = 0;
    (recording.truth.back().configuration.q - recording.truth.front().configuration.q)
        .cwiseAbs()
        .maxCoeff(&variable);
    const int joint = model.tree.variable_joint[static_cast<std::size_t>(variable)];
    run.joint = model.tree.joints[static_cast<std::size_t>(joint)].name;
  }
  return run;
}

}  // namespace lockbox::app
