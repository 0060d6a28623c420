// SPDX-License-Identifier: BSD-3-Clause
// What is minimised, E = E_model + lambda_free E_free + lambda_collision E_collision, of one cloud:
// its linearisations, and its cost under the selection (candidates, variances, visibility,
// correspondences) of the last one (docs/mathematics.md).
#pragma once

#include <optional>
#include <vector>

#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/collision_term.hpp"
#include "lockbox/terms/free_space_term.hpp"
#include "lockbox/terms/model_term.hpp"
#include "lockbox/view/predicted_view.hpp"

namespace lockbox {

/// The objective about one configuration, as a quadratic function of a step.
struct Linearization {
  BodyPoses poses;
  std::vector<BodyJacobian> jacobians;  ///< by body
  NormalEquations data;                 ///< of points and free space, divided by noise_correlation
  NormalEquations all;                  ///< the same, and collisions
  double model_cost = 0.0;              ///< relative to explaining nothing
  double free_cost = 0.0;
  double collision_cost = 0.0;
  double cost = 0.0;  ///< of all

  /// What the data says about an unknown.
  void forget(Eigen::Index unknown);
};

/// Owns the terms, the views that they compare with the cloud, and their memory.
class Objective {
 public:
  /// Model and moves must outlive it. Throws InputError as CollisionTerm does.
  Objective(const ArticulatedModel& model, const RegistrationOptions& options,
            const MotionMetric& moves, const Executor& executor);

  /// Compares with this cloud until the next call; it must live as long.
  void begin(const TiledCloud& cloud, const AlignOptions& align_options);

  /// Whether there is an image, and it is to be looked through where nothing should be seen.
  bool sees_free_space() const;

  /// From now on with a few points only, in a view of few rays, or with all of the point budget.
  void look_roughly() { look_through(approach_view_); }
  void look_closely() { look_through(full_view_); }
  /// Whether looking roughly takes fewer points.
  bool has_rough_view() const;

  /// annealing_sigma: metres that the configuration may still be off. It stays as it is while that,
  /// the view and the configuration do. Valid until the next call.
  Linearization& linearize(const Configuration& configuration, double annealing_sigma);

  /// The cost under the selection of the last linearisation. With next_sigma, the model term is
  /// linearised there on the way, unless the model has to be drawn anew for that.
  double cost(const Configuration& configuration, std::optional<double> next_sigma = std::nullopt);

  /// Clusters of residuals of the last linearisation: those of points.
  void append_tile_systems(std::vector<TileSystem>& systems) const;

  /// In the last linearisation contours get this weight instead of lambda_free; appends the
  /// clusters of free space.
  void weigh_contours(double weight, std::vector<TileSystem>& systems);

  /// Of the cloud that is compared with: the view in hand, drawn anew if it does not show that
  /// configuration. Of another cloud: a view of its own, which no linearisation looks through.
  /// Valid until the next call.
  const PredictedView& view_of(const TiledCloud& cloud, const Configuration& configuration);

  const TiledCloud& cloud() const { return *cloud_; }
  const PredictedView& view() const { return *view_; }  ///< the one in hand
  const ModelTerm::Totals& totals() const { return model_term_.totals(); }
  CollisionTerm& collision() { return collision_; }

 private:
  void look_through(PredictedView& view);
  void look_at(const Configuration& configuration, double annealing_sigma);
  void forget_linearizations();
  ModelTerm::Scene scene() const;
  void linearize_points(const Configuration& configuration, double annealing_sigma);
  void select_free_space(const Configuration& configuration, double annealing_sigma);

  /// A linearisation is there, of this configuration and with this annealing sigma.
  struct Place {
    Configuration configuration;
    std::optional<double> annealing_sigma;  ///< none: there is none

    bool is(const Configuration& other, double other_sigma) const;
    /// Reuses its memory.
    void set(const Configuration& other, double other_sigma);
  };

  const ArticulatedModel& model_;
  RegistrationOptions options_;
  const MotionMetric& moves_;
  Executor executor_;
  ModelTerm model_term_;
  FreeSpaceTerm free_term_;
  CollisionTerm collision_;
  PredictedView approach_view_;
  PredictedView full_view_;
  PredictedView other_view_;  ///< of other clouds
  PredictedView* view_ = nullptr;

  const TiledCloud* cloud_ = nullptr;
  bool is_predicted_ = false;  ///< where the alignment starts
  Linearization linearization_;
  Place linearized_;  ///< all terms
  Place ahead_;       ///< the model term, by cost()
  Place selected_;    ///< the free-space term's selection
  std::vector<BodySystem> systems_;
  BodyPoses trial_poses_;
};

}  // namespace lockbox
