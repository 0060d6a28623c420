// SPDX-License-Identifier: BSD-3-Clause
#include "joint_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lockbox {
namespace {

constexpr int kMoveSamples = 12;  // of the move in question
constexpr int kOtherSamples = 4;  // of what is left of the moves under way

/// A time of rest at the run's beginning and end that differs from joint to joint, as a share of
/// the run: multiples of the golden ratio fill an interval evenly.
double pause(int variable, double shift) {
  const double x = variable * std::numbers::phi + shift;
  return 0.25 * (x - std::floor(x));
}

std::array<double, JointMoves::kMoves + 1> stations(double rest, const VariableLimits& limits,
                                                    double coverage) {
  const bool bounded = std::isfinite(limits.lower) && std::isfinite(limits.upper);
  const double lower = bounded ? limits.lower : rest - std::numbers::pi;
  const double upper = bounded ? limits.upper : rest + std::numbers::pi;
  const double margin = 0.5 * (1.0 - coverage) * (upper - lower);
  double first = upper - margin;
  double second = lower + margin;
  if (std::abs(second - rest) > std::abs(first - rest)) {
    std::swap(first, second);
  }
  return {rest, first, second, rest};
}

}  // namespace

double JointMoves::position(double time) const {
  std::size_t move = 0;
  while (std::cmp_less(move + 1, planned) && time >= begins[move + 1]) {
    ++move;
  }
  const double progress = planned > 0 ? smooth_step((time - begins[move]) / duration) : 0.0;
  return positions[move] + progress * (positions[move + 1] - positions[move]);
}

JointSchedule::JointSchedule(const KinematicTree& tree, const TrajectoryOptions& options)
    : rest_(rest_configuration(tree)) {
  for (int v = 0; v < tree.variables(); ++v) {
    JointMoves& joint = joints_.emplace_back();
    joint.positions = stations(rest_.q[v], variable_limits(tree, v), options.coverage);
    joint.duration = (1.0 - pause(v, 0.5) - pause(v, 0.0)) / JointMoves::kMoves;
  }
  plan(options);
}

Eigen::VectorXd JointSchedule::positions(double share) const {
  Eigen::VectorXd q(rest_.q.size());
  for (std::size_t v = 0; v < joints_.size(); ++v) {
    q[static_cast<Eigen::Index>(v)] = joints_[v].position(share * end_);
  }
  return q;
}

/// Who waits longest goes first: a door that opened would close again before the drawer behind it
/// has moved.
void JointSchedule::plan(const TrajectoryOptions& options) {
  std::vector<Waiting> waiting;
  for (std::size_t v = 0; v < joints_.size(); ++v) {
    waiting.push_back({v, pause(static_cast<int>(v), 0.0)});
  }
  double time = 0.0;
  while (!waiting.empty()) {
    std::stable_sort(waiting.begin(), waiting.end(),
                     [](const Waiting& a, const Waiting& b) { return a.since < b.since; });
    const double running_until = next_end(time);
    const bool nothing_moves = running_until == std::numeric_limits<double>::infinity();
    auto next = std::find_if(waiting.begin(), waiting.end(), [&](const Waiting& one) {
      return one.since <= time && is_clear(one.joint, time, options);
    });
    if (next == waiting.end()) {
      const auto due = std::find_if(waiting.begin(), waiting.end(),
                                    [&](const Waiting& one) { return one.since > time; });
      const bool one_comes = due != waiting.end();
      if (one_comes || !nothing_moves) {
        time = one_comes ? std::min(due->since, running_until) : running_until;
        continue;
      }
      next = waiting.begin();  // no order helps
    }
    JointMoves& joint = joints_[next->joint];
    joint.begins[static_cast<std::size_t>(joint.planned++)] = time;
    next->since = time + joint.duration;
    end_ = std::max(end_, next->since);
    if (joint.planned == JointMoves::kMoves) {
      waiting.erase(next);
    }
  }
}

/// When the first of the moves under way ends; infinity if there is none.
double JointSchedule::next_end(double time) const {
  double end = std::numeric_limits<double>::infinity();
  for (const JointMoves& joint : joints_) {
    if (joint.planned > 0 && joint.end_of(joint.planned - 1) > time) {
      end = std::min(end, joint.end_of(joint.planned - 1));
    }
  }
  return end;
}

bool JointSchedule::is_clear(std::size_t joint, double time,
                             const TrajectoryOptions& options) const {
  if (!options.is_possible) {
    return true;
  }
  const JointMoves& mover = joints_[joint];
  const auto move = static_cast<std::size_t>(mover.planned);
  Configuration trial = rest_;
  for (int other = 0; other <= kOtherSamples; ++other) {
    for (std::size_t v = 0; v < joints_.size(); ++v) {
      trial.q[static_cast<Eigen::Index>(v)] =
          joints_[v].position(time + joints_[v].duration * other / kOtherSamples);
    }
    for (int sample = 0; sample <= kMoveSamples; ++sample) {
      const double share = static_cast<double>(sample) / kMoveSamples;
      trial.q[static_cast<Eigen::Index>(joint)] =
          mover.positions[move] + share * (mover.positions[move + 1] - mover.positions[move]);
      if (!options.is_possible(trial)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace lockbox
