// SPDX-License-Identifier: BSD-3-Clause
// What follows the descent: steps that would lead astray from farther off
// (docs/mathematics-refinement.md). Each takes the estimate, and what is known of it by then, and
// improves both.
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
  /// Steps must outlive it.
  explicit ContourStep(Steps& steps) : steps_(steps) {}

  /// The clusters of the solution follow the step.
  void take(const PinholeCamera& camera, bool hold_joints, SolutionSystem& solution,
            Estimate& estimate);

 private:
  Steps& steps_;
  std::vector<Twist> body_steps_;  ///< memory: what the step moves each body by
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

  /// start: the joint variables before the descent. at: where it has ended; costs are those under
  /// its selection. solution: what it says about such joints is forgotten. matches: none of each
  /// variable before.
  void take(const Comparison& with, const Eigen::VectorXd& start, const Linearization& at,
            SolutionSystem& solution, Estimate& estimate, JointMatches& matches);

 private:
  bool is_elsewhere(const Comparison& with, const Configuration& estimate, int variable,
                    const std::optional<JointMatch>& match, const Linearization& at);

  const ArticulatedModel& model_;
  RegistrationOptions options_;
  Objective& objective_;
  const Steps& steps_;
  LowProminence low_prominence_;
  Configuration candidate_;  ///< memory
};

/// The last step, from all that has been found, by the likelihood of the image at the model's
/// edges: a pixel or less. What is not known yet stays so: a smooth disk has edges, but what they
/// tell about its angle are its facets.
class EdgeStep {
 public:
  /// Model, collision and steps must outlive it.
  EdgeStep(const ArticulatedModel& model, const RegistrationOptions& options,
           CollisionTerm& collision, Steps& steps, const Executor& executor);

  /// with: as it was drawn for the solution. poses: of the estimate. covariance: what is known by
  /// now; what edges tell is added.
  void take(const Comparison& with, const BodyPoses& poses, bool hold_joints, Estimate& estimate,
            CovarianceEstimator& covariance);

 private:
  const ArticulatedModel& model_;
  std::size_t patches_per_joint_;  ///< 0: the step is not taken
  CollisionTerm& collision_;
  Steps& steps_;
  EdgeTerm edges_;
  std::vector<BodyJacobian> jacobians_;  ///< memory, as all that follows
  NormalEquations at_edges_;
  NormalEquations all_;
};

}  // namespace lockbox
