// SPDX-License-Identifier: BSD-3-Clause
// How far an estimate is from a reference, frame by frame and in total.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/evaluation/bounds_file.hpp"
#include "lockbox/evaluation/equal_poses.hpp"
#include "lockbox/evaluation/statistics.hpp"
#include "lockbox/evaluation/status_count.hpp"
#include "lockbox/evaluation/tolerances.hpp"
#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/model/states_file.hpp"

namespace lockbox {

/// Estimate against reference at the time of one reference state. Errors are NaN where the estimate
/// says nothing.
struct FrameErrors {
  double stamp;                  ///< of the reference, seconds
  std::string status;            ///< of the estimate; empty if there is none near this time
  double translation;            ///< of the base, metres
  double rotation;               ///< of the base, radians, geodesic
  Eigen::VectorXd joints;        ///< estimate - reference by joint; continuous ones within +-pi
  Eigen::VectorXd joint_sigmas;  ///< as the estimate reports them, NaN if it does not
  Determined determined;         ///< by the bounds; everything without bounds
};

/// Whether an estimate admits what it cannot know, in frames that do not determine the unknown.
struct Honesty {
  std::size_t frames = 0;  ///< undetermined, with an estimate and its sigma
  std::size_t honest = 0;  ///< |error| <= 3 sigma, or flagged unobservable
};

struct JointSummary {
  int joint;          ///< of the tree
  Statistics errors;  ///< over frames that determine it, radians or metres
  Honesty honesty;
};

struct Evaluation {
  std::vector<FrameErrors> frames;   ///< one a reference state
  std::size_t unmatched = 0;         ///< reference states without an estimate near them
  Statistics translation;            ///< metres, over frames that determine it
  Statistics rotation;               ///< radians
  std::vector<JointSummary> joints;  ///< in the order of the file
  StatusCount statuses;
};

/// Pairs each reference state with the estimate nearest in time, at most half a frame away (half
/// the median distance of reference states), and compares them. The stamps of both must increase.
/// Joint sigmas come from the estimate's columns `<joint>.sigma`; a joint counts as flagged
/// unobservable if its sigma is infinite or at least a quarter of the joint's range (of pi for
/// continuous joints). bounds: for the reference's stamps; frames without a bound count as
/// determining nothing. equal: of the true pose, that which is nearest to the estimate counts.
/// Throws InputError if either file has no states, or stamps that do not increase.
Evaluation evaluate(const KinematicTree& tree, const StatesFile& estimate,
                    const StatesFile& reference,
                    const std::optional<std::vector<FrameBound>>& bounds = std::nullopt,
                    const Tolerances& tolerances = {}, const EqualPoses& equal = {});

}  // namespace lockbox
