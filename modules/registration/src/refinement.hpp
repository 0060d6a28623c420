// SPDX-License-Identifier: BSD-3-Clause
// What follows the descent: steps that would lead astray from farther off (docs/mathematics.md).
// Each takes the estimate, and what is known of it by then, and improves both.
#pragma once

#include <optional>
#include <vector>

#include "lockbox/solver/covariance.hpp"
#include "lockbox/terms/edge_term.hpp"
#include "lockbox/terms/low_prominence.hpp"
#include "objective.hpp"
#include "steps.hpp"

namespace lockbox {

/// The estimate while it is refined.
struct Estimate {
  Configuration configuration;
  Configuration at_rest;  ///< before contours and edges: where to begin the next time
};

/// One more step, in which contours weigh what their pixels are worth. From farther off, such
/// weights would keep the estimate in wrong minima.
class ContourStep {
 public:
  /// Objective and steps must outlive it.
  ContourStep(const RegistrationOptions& options, Objective& objective, Steps& steps);

  /// at: the last linearisation, which gets these weights. tiles: the clusters of residuals, which
  /// follow the step; those of free space are added.
  void take(Linearization& at, bool hold_joints, Estimate& estimate,
            std::vector<TileSystem>& tiles);

 private:
  double weight_;
  Objective& objective_;
  Steps& steps_;
  std::vector<Twist> body_steps_;  ///< what the step moves each body by
};

/// By joint variable, where the image shows it; none for those that were not looked for, or not
/// seen.
using JointMatches = std::vector<std::optional<JointMatch>>;

/// Joints of low prominence are where the image shows them; what points say about them is noise. Of
/// those that stand out a little more, points say more than the image, unless they are far off.
class ProminenceStep {
 public:
  /// Model, objective and steps must outlive it.
  ProminenceStep(const ArticulatedModel& model, const RegistrationOptions& options,
                 Objective& objective, const Steps& steps, const Executor& executor);

  /// start: the joint variables before the descent. at: what it says about such joints is
  /// forgotten. matches: none of each variable before.
  void take(const Eigen::VectorXd& start, Linearization& at, Estimate& estimate,
            JointMatches& matches);

 private:
  bool is_elsewhere(const Configuration& estimate, int variable,
                    const std::optional<JointMatch>& match);

  const ArticulatedModel& model_;
  RegistrationOptions options_;
  Objective& objective_;
  const Steps& steps_;
  LowProminence low_prominence_;
  Configuration candidate_;
};

/// The last step, from all that has been found, by the likelihood of the image at the model's
/// edges: a pixel or less. What is not known yet stays so: a smooth disk has edges, but what they
/// tell about its angle are its facets.
class EdgeStep {
 public:
  /// Model, objective and steps must outlive it.
  EdgeStep(const ArticulatedModel& model, const RegistrationOptions& options, Objective& objective,
           Steps& steps, const Executor& executor);

  /// poses: of the estimate. covariance: what is known by now; what edges tell is added.
  void take(const BodyPoses& poses, bool hold_joints, Estimate& estimate,
            CovarianceEstimator& covariance);

 private:
  const ArticulatedModel& model_;
  std::size_t patches_per_joint_;  ///< 0: the step is not taken
  Objective& objective_;
  Steps& steps_;
  EdgeTerm edges_;
  std::vector<BodyJacobian> jacobians_;
  NormalEquations at_edges_;
  NormalEquations all_;
};

}  // namespace lockbox
