// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "frame_errors.hpp"

namespace lockbox {
namespace {

constexpr Tolerances kNoiseLevel{0.002, 0.0034906585};  // base: 2 mm, 0.2 degrees
constexpr double kNoiseShare = 0.2;                     // of the joints' tolerances

State as_state(const TrackingResult& result) {
  return {result.stamp,
          result.configuration,
          to_string(result.status),
          result.configuration.T_camera_base.matrix().allFinite(),
          {}};
}

}  // namespace

bool FrameOutcome::is_right(const Tolerances& tolerances) const {
  return translation <= tolerances.translation && rotation <= tolerances.rotation && joints <= 1.0;
}

bool FrameOutcome::is_at_noise_level() const {
  return is_right(kNoiseLevel) && joints <= kNoiseShare;
}

StatusCount count_statuses(const std::vector<FrameOutcome>& frames) {
  StatusCount count;
  for (const FrameOutcome& frame : frames) {
    count.add(frame.status == TrackingStatus::tracking, frame.is_right());
  }
  return count;
}

FrameOutcome compare(const KinematicTree& tree, const TrackingResult& result, const State& truth) {
  const FrameErrors errors = FrameComparison(tree, {}).compare(as_state(result), truth);
  FrameOutcome outcome{result.status, result.searches, errors.translation, errors.rotation, 0.0};
  for (std::size_t j = 0; j < tree.joints.size(); ++j) {
    const auto unknown = static_cast<std::size_t>(unknown_of(tree.joints[j].variable));
    if (unknown >= result.observable.size() || !result.observable[unknown]) continue;
    const double error = std::abs(errors.joints(static_cast<Eigen::Index>(j)));
    const double share = error / Tolerances{}.joint(tree.joints[j].type);
    if (share <= outcome.joints) continue;
    outcome.joints = share;
    outcome.worst_joint = tree.joints[j].name;
  }
  return outcome;
}

StatesFile to_states(const KinematicTree& tree, const std::vector<TrackingResult>& results) {
  StatesFile file;
  for (const int joint : tree.file_order) {
    file.extra_columns.push_back(tree.joints[static_cast<std::size_t>(joint)].name + ".sigma");
  }
  for (const TrackingResult& result : results) {
    State& state = file.states.emplace_back(as_state(result));
    for (const int index : tree.file_order) {
      const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
      const auto unknown = static_cast<std::size_t>(unknown_of(joint.variable));
      const bool observable = unknown < result.observable.size() && result.observable[unknown];
      const double sigma =
          observable ? std::abs(joint.multiplier) * result.sigma(unknown_of(joint.variable))
                     : std::numeric_limits<double>::infinity();
      state.extra.push_back(number_text(sigma));
    }
  }
  return file;
}

}  // namespace lockbox
