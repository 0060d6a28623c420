// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with an answer that was found without a guess.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "lockbox/evaluation/frame_outcome.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

/// Whether a frame with this bound (see bound_sigma) tells the base to 5 mm and 0.5 degrees.
bool determines_base(const Eigen::VectorXd& bound);

struct AnswerErrors {
  FrameOutcome outcome;  ///< against the nearest pose that looks the same; NaN without an answer
  std::string wrong;     ///< "nothing", "base", or the joints that are wrong
};

class AnswerComparison {
 public:
  /// tolerances: of what counts as wrong. The model must outlive it.
  AnswerComparison(const ArticulatedModel& model, const Tolerances& tolerances);

  /// Joints are compared whose bound in the frame is below a tenth of their tolerance. Of poses and
  /// joint positions that look the same as the true ones the nearest counts.
  AnswerErrors compare(const TrackingResult& answer, const State& true_state,
                       const Eigen::VectorXd& bound) const;

 private:
  /// The truth, with joints where they look the same and are nearest to the answer's.
  State nearest_truth(State truth, const Configuration& answer) const;
  std::string wrong_joints(const Configuration& answer, const State& truth,
                           const Eigen::VectorXd& bound) const;

  const ArticulatedModel& model_;
  Tolerances tolerances_;
  std::vector<Eigen::Isometry3d> symmetries_;
  std::vector<int> joint_turns_;  ///< by variable, count_joint_turns()
};

}  // namespace lockbox
