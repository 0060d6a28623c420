// SPDX-License-Identifier: BSD-3-Clause
// What is minimised, E = E_model + lambda_free E_free + lambda_collision E_collision, of one cloud:
// its linearisations, and its cost under the selection (candidates, variances, visibility,
// correspondences) of one of them (docs/mathematics.md).
#pragma once

#include <vector>

#include "linearization.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/terms/collision_term.hpp"
#include "lockbox/terms/free_space_term.hpp"
#include "lockbox/terms/model_term.hpp"
#include "lockbox/view/predicted_view.hpp"
#include "views.hpp"

namespace lockbox {

/// The sum of the terms. No call depends on an earlier one but by what it is given: of its own it
/// keeps memory, and the collision term's, which changes no result.
class Objective {
 public:
  /// Model and moves must outlive it. Throws InputError as CollisionTerm does.
  Objective(const ArticulatedModel& model, const RegistrationOptions& options,
            const MotionMetric& moves, const Executor& executor);

  /// Whether there is an image, and it is to be looked through where nothing should be seen.
  bool sees_free_space(const TiledCloud& cloud) const;

  /// Draws the view, unless it shows the configuration already. annealing_sigma: metres that the
  /// configuration may still be off.
  void draw(const Comparison& with, const Configuration& configuration,
            double annealing_sigma) const;

  /// Draws the view if need be, and linearises all terms. What is there already stays as it is:
  /// all of it at the same place, the model term that cost() had ready, the selection of free space
  /// near where it was made.
  void linearize(const Comparison& with, const Configuration& configuration, double annealing_sigma,
                 Linearization& at);

  /// The cost at another configuration, under the selection of a linearisation with the same view.
  double cost(const Comparison& with, const Configuration& configuration,
              const Linearization& under);

  /// The same, and has the model term's next linearisation ready on the way, with next_sigma,
  /// unless the model has to be drawn anew for that.
  double cost_ahead(const Comparison& with, const Configuration& configuration, double next_sigma,
                    Linearization& under);

  /// Where the descent has ended, contours weigh what their pixels are worth instead of
  /// lambda_free.
  void weigh_solution(const Comparison& with, const Linearization& at, SolutionSystem& solution);

  CollisionTerm& collision() { return collision_; }

 private:
  ModelTerm::Scene scene(const Comparison& with) const;
  template <typename PointCost>
  double cost_with(const Comparison& with, const Configuration& configuration,
                   const FreeSpaceTerm& free_term, PointCost&& cost_of_points);
  void linearize_points(const Comparison& with, const Configuration& configuration,
                        double annealing_sigma, Linearization& at);
  void select_free_space(const Comparison& with, const Configuration& configuration,
                         double annealing_sigma, Linearization& at) const;

  const ArticulatedModel& model_;
  RegistrationOptions options_;
  const MotionMetric& moves_;
  Executor executor_;
  CollisionTerm collision_;
  std::vector<BodySystem> systems_;  ///< memory, as all that follows
  BodyPoses trial_poses_;
};

}  // namespace lockbox
