// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/joint_sight.hpp"

#include <algorithm>
#include <cstddef>

namespace lockbox {
namespace {

constexpr int kFramesToKnow = 2;  // a joint that comes back into sight is sought until then
/// Joints that are sought in a frame. Unit: 1. Source: as many as the lockbox
/// has, all of which may come back into sight at once. Doubled, a frame of an arm of twenty joints
/// takes twice as long.
constexpr std::size_t kMostSought = 8;

}  // namespace

JointSight::JointSight(const KinematicTree& tree)
    : tree_(tree),
      waits_(static_cast<std::size_t>(tree.variables()), false),
      frames_in_sight_(waits_.size(), 0),
      is_flush_(waits_.size(), false) {}

std::vector<int> JointSight::sought() {
  std::vector<int> variables;
  for (int i = 0; i < tree_.variables(); ++i) {
    const auto v = static_cast<std::size_t>((next_ + i) % tree_.variables());
    const bool is_unknown = !is_known(static_cast<int>(v)) && !is_flush_[v];
    waits_[v] = is_unknown && variables.size() == kMostSought;
    if (is_unknown && !waits_[v]) variables.push_back(static_cast<int>(v));
  }
  if (variables.size() == kMostSought) next_ = (next_ + 1) % tree_.variables();
  std::sort(variables.begin(), variables.end());
  return variables;
}

bool JointSight::is_known(int variable) const {
  return frames_in_sight_[static_cast<std::size_t>(variable)] >= kFramesToKnow;
}

void JointSight::note_flush_parts(const Answer& found, const TrackerOptions& options) {
  for (int v = 0; v < tree_.variables(); ++v) {
    is_flush_[static_cast<std::size_t>(v)] = is_flush(found, v, options);
  }
}

bool JointSight::is_flush(const Answer& found, int variable, const TrackerOptions& options) const {
  const int joint = tree_.variable_joint[static_cast<std::size_t>(variable)];
  const auto body =
      static_cast<std::size_t>(tree_.joints[static_cast<std::size_t>(joint)].child_body);
  return !found.observable[static_cast<std::size_t>(unknown_of(variable))] &&
         body < found.flush_bodies.size() && found.flush_bodies[body] &&
         found.body_agreement[body].explained >= options.least_of_sought_body;
}

void JointSight::count(const Answer& found, const JointMargins& margins,
                       const TrackerOptions& options) {
  for (int v = 0; v < tree_.variables(); ++v) {
    const bool is_in_sight = !waits_[static_cast<std::size_t>(v)] &&
                             found.observable[static_cast<std::size_t>(unknown_of(v))] &&
                             !is_doubtful(found, v, margins, tree_, options);
    int& frames = frames_in_sight_[static_cast<std::size_t>(v)];
    frames = is_in_sight ? frames + 1 : 0;
  }
}

void JointSight::begin(const Answer& found) {
  std::transform(found.observable.begin() + kBaseUnknowns, found.observable.end(),
                 frames_in_sight_.begin(),
                 [](bool is_determined) { return is_determined ? kFramesToKnow : 0; });
  std::fill(waits_.begin(), waits_.end(), false);
}

}  // namespace lockbox
