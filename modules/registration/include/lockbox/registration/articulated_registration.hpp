// SPDX-License-Identifier: BSD-3-Clause
// One registration step: cloud and starting configuration in, best configuration out.
//
// Levenberg-Marquardt on E = E_model + lambda_free E_free + lambda_collision E_collision. An
// iteration is one linearisation; its first trial is undamped; costs are compared under the
// selection (candidates, variances, visibility, correspondences) of that linearisation.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/solver/bounded_step.hpp"
#include "lockbox/solver/covariance.hpp"
#include "lockbox/solver/surface_moves.hpp"
#include "lockbox/terms/collision_term.hpp"
#include "lockbox/terms/edge_term.hpp"
#include "lockbox/terms/free_space_term.hpp"
#include "lockbox/terms/low_relief.hpp"
#include "lockbox/terms/model_term.hpp"
#include "lockbox/verification/agreement.hpp"
#include "lockbox/view/predicted_view.hpp"

namespace lockbox {

/// Gates begin with the spread and end with the sensor's noise alone.
struct Annealing {
  double spread = 0.0;       ///< metres: how far surfaces may be from where the start puts them
  int iterations = 3;        ///< linearisations, at most
  bool hold_joints = false;  ///< move the base only
  int narrowing = 0;         ///< linearisations until the spread is gone; 0: all of them
  /// The start is a prediction. Of flat faces, points are pooled (pooled_points.hpp); of many
  /// points a few are enough for all iterations but the last, which follows as soon as steps are
  /// short. If its own is not, it may take twice as many linearisations again.
  bool is_predicted = false;
  /// Sees the configuration after each linearisation, and whether the gates are narrow by then; may
  /// end the alignment by returning false.
  std::function<bool(const Configuration& configuration, bool is_narrow)> on_iteration = nullptr;
  bool at_edges = true;  ///< end with the step by the image at edges, if the options ask for it
  /// The cloud is that of the last alignment: what was drawn for it, and what was sought then of
  /// free space, is as good as within one alignment while surfaces are nearly where they were.
  bool goes_on = false;
};

struct RegistrationResult {
  Configuration configuration;  ///< the estimate
  /// Before the last step, in which outlines weigh more (docs/mathematics.md): where to begin the
  /// next time.
  Configuration at_rest;
  Eigen::MatrixXd covariance;      ///< of (base twist, variables); twist in the base's frame
  Eigen::VectorXd sigma;           ///< standard deviations, square roots of its diagonal
  Eigen::VectorXd sigma_of_noise;  ///< the same, were the object exactly its model
  std::vector<bool> observable;    ///< by unknown: whether the data determines it
  Agreement agreement;
  std::vector<Agreement> body_agreement;  ///< by body
  OutlineAgreement outline;
  /// By body: whether it is flush with what is around it, so that its edges tell little or nothing
  /// (continued_edges.hpp). Empty for clouds without an image.
  std::vector<bool> flush_bodies;
  double residual_rms = 0.0;      ///< whitened: 1 where the sensor errs as assumed
  double explained_points = 0.0;  ///< pixels, where points are means of such
  double model_cost = 0.0;        ///< relative to explaining nothing
  double free_cost = 0.0;
  double collision_cost = 0.0;
  int iterations = 0;
  /// Metres that the last iteration moved surfaces, at most, beyond what noise does: 0 at rest.
  double last_move = 0.0;
  /// Metres to where the base may be as well, if a search of the whole view could not tell; else 0.
  double rival_distance = 0.0;
  /// The probability that this is the object, where the image was asked for it; else 0.
  double belief = 0.0;
  bool converged = false;
};

/// Owns all memory of the loop; use one per thread. The model must outlive it.
class ArticulatedRegistration {
 public:
  ArticulatedRegistration(const ArticulatedModel& model, const RegistrationOptions& options,
                          const Executor& executor);

  /// The result is valid until the next call. A cloud without an image has no free-space term.
  const RegistrationResult& align(const TiledCloud& cloud, const Configuration& start,
                                  const Annealing& annealing);

  const RegistrationOptions& options() const { return options_; }
  const CollisionTerm& collision() const { return collision_; }
  const ArticulatedModel& model() const { return model_; }
  const SurfaceMoves& moves() const { return moves_; }

 private:
  void descend(const TiledCloud& cloud, const Annealing& annealing);
  bool add_short_step(bool hold_joints, double farthest, Configuration& configuration);
  void settle(const TiledCloud& cloud, const Annealing& annealing, bool is_to_report);
  bool report(const Annealing& annealing, bool is_narrow);
  const Eigen::VectorXd& next_step(bool hold_joints);
  void estimate_covariance();
  void find_rest(bool hold_joints);
  bool takes_last_steps(const TiledCloud& cloud) const;
  void look_through(PredictedView& view);
  ModelTerm::Scene scene(const TiledCloud& cloud) const;
  void linearize_at_points(const TiledCloud& cloud, double spread);
  double linearize(const TiledCloud& cloud, double spread);
  double cost_at(const TiledCloud& cloud, const Configuration& configuration,
                 std::optional<double> next_spread);
  void refine(const PinholeCamera& camera, bool hold_joints);
  void refine_at_edges(const TiledCloud& cloud, bool hold_joints);
  double surfaces_seen_to_move(const PinholeCamera& camera) const;
  bool is_elsewhere(const TiledCloud& cloud, int variable,
                    const std::optional<JointSighting>& sighting);
  void sight_low_relief(const TiledCloud& cloud);
  void forget(Eigen::Index unknown);
  bool improve(const TiledCloud& cloud, double cost, bool hold_joints, double next_spread);
  void set_step_limits(bool hold_joints);
  void select_free_space(const TiledCloud& cloud, double spread);

  const ArticulatedModel& model_;
  RegistrationOptions options_;
  Executor executor_;
  ModelTerm model_term_;
  FreeSpaceTerm free_term_;
  CollisionTerm collision_;
  LowRelief low_relief_;
  EdgeTerm edges_;
  PredictedView approach_view_;
  PredictedView full_view_;
  PredictedView* view_ = nullptr;  ///< the one in hand
  StepScale scale_;
  SurfaceMoves moves_;

  RegistrationResult result_;
  Eigen::VectorXd start_;   ///< joint variables
  Configuration selected_;  ///< where the free-space term made its selection
  double selected_spread_ = 0.0;
  bool is_predicted_ = false;                ///< the start
  std::optional<double> linearized_spread_;  ///< if all terms stand at result_.configuration
  std::optional<double> ahead_spread_;       ///< if the model term was linearised there already
  double cost_ = 0.0;                        ///< of the last linearisation
  BodyPoses poses_;
  BodyPoses trial_poses_;
  std::vector<BodyJacobian> jacobians_;
  std::vector<BodySystem> systems_;
  NormalEquations data_equations_;
  NormalEquations equations_;
  NormalEquations edge_equations_;
  StepLimits limits_;
  BoundedStepSolver solver_;
  Configuration candidate_;
  Eigen::VectorXd last_step_;  ///< zero if the last iteration found none worth taking
  std::vector<bool> held_;     ///< by unknown
  std::vector<std::optional<JointSighting>> sightings_;  ///< by variable
  CovarianceEstimator covariance_;
  std::vector<TileSystem> tile_systems_;
  std::vector<Twist> body_steps_;  ///< what the last step moves each body by
  AgreementMeter agreement_;
};

}  // namespace lockbox
