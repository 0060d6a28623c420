// SPDX-License-Identifier: BSD-3-Clause
// What Objective::linearize() finds about one configuration, and how the stages after the descent
// weigh it.
#pragma once

#include <vector>

#include "lockbox/model/configuration.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/free_space_term.hpp"
#include "lockbox/terms/model_term.hpp"

namespace lockbox {

class PredictedView;

/// The objective about one configuration, as a quadratic function of a step, and the selection
/// (candidates, variances, visibility, correspondences) under which it is one. Its memory is used
/// again.
struct Linearization {
  /// What something was made of: a view, a configuration and an annealing sigma, metres.
  class Place {
   public:
    bool is(const PredictedView& view, const Configuration& configuration, double sigma) const;
    /// Returns whether it is the same view, with surfaces at most so many metres from there, and
    /// gates no wider.
    bool is_near(const PredictedView& view, const Configuration& configuration, double sigma,
                 double metres, const MotionMetric& moves) const;
    void set(const PredictedView& view, const Configuration& configuration, double sigma);
    void forget() { view_ = nullptr; }

   private:
    const PredictedView* view_ = nullptr;  ///< null: nothing was made
    Configuration configuration_;
    double sigma_ = 0.0;
  };

  BodyPoses poses;
  std::vector<BodyJacobian> jacobians;  ///< by body
  NormalEquations data;                 ///< of points and free space, divided by noise_correlation
  NormalEquations all;                  ///< the same, and collisions
  double model_cost = 0.0;              ///< relative to explaining nothing
  double free_cost = 0.0;
  double collision_cost = 0.0;
  double cost = 0.0;         ///< of all
  ModelTerm::Totals totals;  ///< of points
  Place linearized_at;       ///< what all of this is of
  ModelTerm model_term;      ///< with its selection there
  Place ahead_at;            ///< of the linearisation that the model term has ready
  FreeSpaceTerm free_term;   ///< with its selection
  Place selected_at;         ///< of that selection, which lasts a little longer

  /// Begins with a cloud. goes_on: it is that of the last time, and so the selection of free space
  /// is still of use.
  void begin(bool goes_on);
};

/// What the image says of the solution, by the weights of the stages after the descent.
struct SolutionSystem {
  std::vector<BodyJacobian> jacobians;  ///< by body
  NormalEquations data;                 ///< of points and free space, divided by noise_correlation
  NormalEquations all;                  ///< the same, and collisions
  std::vector<TileSystem> clusters;     ///< of residuals, of the data

  /// What the data says about an unknown.
  void forget(Eigen::Index unknown);
};

}  // namespace lockbox
