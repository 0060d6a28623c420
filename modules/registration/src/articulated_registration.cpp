// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/articulated_registration.hpp"

#include <algorithm>
#include <cmath>

#include "descent.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/verification/consistency_check.hpp"
#include "refinement.hpp"
#include "size_meter.hpp"

namespace lockbox {
namespace {

/// Of turns that change what is seen: not about the axes, of which two or more are those of a ball.
double turning_sigma(const Eigen::Matrix3d& covariance,
                     const std::vector<Eigen::Vector3d>& round_axes) {
  if (round_axes.size() > 1) return 0.0;
  Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
  for (const Eigen::Vector3d& axis : round_axes) across -= axis * axis.transpose();
  return std::sqrt(std::max(0.0, (across * covariance * across).trace()));
}

}  // namespace

/// The stages of an alignment, in the order in which align() calls them. What a stage reads and
/// what it changes are its parameters; the members at the end are memory that is reused.
struct ArticulatedRegistration::Stages {
  Stages(const ArticulatedModel& of, const RegistrationOptions& how, const Executor& with)
      : model(of),
        options(how),
        executor(with),
        steps(of.tree, how),
        objective(of, how, steps.moves(), with),
        descent(how, objective, steps),
        contour_step(how, objective, steps),
        prominence_step(of, how, objective, steps, with),
        edge_step(of, how, objective, steps, with),
        size_meter(of, how, steps) {
    options.locked.resize(static_cast<std::size_t>(of.tree.variables()), false);
  }

  void align(const TiledCloud& cloud, const Configuration& start, const AlignOptions& align_options,
             RegistrationResult& result);
  /// Steps by contours and by low prominence. clusters: of residuals, with the weights of these
  /// steps.
  void refine_without_edges(const Configuration& start, const AlignOptions& align_options,
                            Linearization& solution, Estimate& refined,
                            std::vector<TileSystem>& clusters, JointMatches& seen);
  /// Before edges add to it.
  void estimate_covariance(const Linearization& solution, const std::vector<TileSystem>& clusters,
                           const JointMatches& seen, CovarianceEstimator& estimated) const;
  /// The consistency check; meanwhile: what is done along with it.
  void compare_with_image(const BodyPoses& at, FunctionRef<void()> meanwhile,
                          ConsistencyCheck& compared) const;
  void report(const Descended& descended, const Estimate& refined, const Linearization& solution,
              const CovarianceEstimator& estimated, const ConsistencyCheck& compared,
              RegistrationResult& reported) const;

  const ArticulatedModel& model;
  RegistrationOptions options;
  Executor executor;
  Steps steps;
  Objective objective;
  Descent descent;
  ContourStep contour_step;
  ProminenceStep prominence_step;
  EdgeStep edge_step;
  SizeMeter size_meter;

  Estimate estimate;
  BodyPoses poses;                ///< of the estimate
  std::vector<TileSystem> tiles;  ///< clusters of residuals
  JointMatches matches;
  ConsistencyCheck agreement;
  CovarianceEstimator covariance;
};

void ArticulatedRegistration::Stages::align(const TiledCloud& cloud, const Configuration& start,
                                            const AlignOptions& align_options,
                                            RegistrationResult& result) {
  objective.begin(cloud, align_options);
  const Descended& descended = descent.run(start, align_options);
  // The covariance, and what the model explains, belong to the solution.
  Linearization& solution = objective.linearize(descended.configuration, 0.0);
  estimate.configuration = descended.configuration;
  descent.find_rest(solution, align_options.hold_joints, estimate.at_rest);
  refine_without_edges(start, align_options, solution, estimate, tiles, matches);
  forward_kinematics(model.tree, estimate.configuration, poses);
  // Neither needs the other.
  const auto covariance_of_points = [&] {
    estimate_covariance(solution, tiles, matches, covariance);
  };
  compare_with_image(poses, covariance_of_points, agreement);
  if (align_options.iterations > 0 && align_options.at_edges) {
    edge_step.take(poses, align_options.hold_joints, estimate, covariance);
  }
  covariance.add_floors(steps.moves().scales());
  report(descended, estimate, solution, covariance, agreement, result);
}

void ArticulatedRegistration::Stages::refine_without_edges(
    const Configuration& start, const AlignOptions& align_options, Linearization& solution,
    Estimate& refined, std::vector<TileSystem>& clusters, JointMatches& seen) {
  clusters.clear();
  objective.append_tile_systems(clusters);
  seen.assign(static_cast<std::size_t>(model.tree.variables()), std::nullopt);
  if (!objective.sees_free_space()) return;
  contour_step.take(solution, align_options.hold_joints, refined, clusters);
  if (align_options.iterations > 0 && !align_options.hold_joints) {
    prominence_step.take(start.q, solution, refined, seen);
  }
}

void ArticulatedRegistration::Stages::compare_with_image(const BodyPoses& at,
                                                         FunctionRef<void()> meanwhile,
                                                         ConsistencyCheck& compared) const {
  const PredictedView& view = objective.view();
  compared.measure(model, view.surface(), view.samples(), at, objective.cloud(), options, executor,
                   meanwhile);
}

void ArticulatedRegistration::Stages::estimate_covariance(const Linearization& solution,
                                                          const std::vector<TileSystem>& clusters,
                                                          const JointMatches& seen,
                                                          CovarianceEstimator& estimated) const {
  estimated.estimate(solution.data, clusters, options.noise_correlation, solution.jacobians,
                     steps.scale(), steps.held());
  for (std::size_t v = 0; v < seen.size(); ++v) {
    if (!seen[v]) continue;
    estimated.set_independent(static_cast<Eigen::Index>(6 + v), seen[v]->variance);
  }
}

void ArticulatedRegistration::Stages::report(const Descended& descended, const Estimate& refined,
                                             const Linearization& solution,
                                             const CovarianceEstimator& estimated,
                                             const ConsistencyCheck& compared,
                                             RegistrationResult& reported) const {
  reported.configuration = refined.configuration;
  reported.at_rest = refined.at_rest;
  reported.covariance = estimated.covariance();
  reported.sigma = estimated.sigma();
  reported.sigma_of_noise = estimated.sigma_of_noise();
  reported.observable = estimated.observable();
  Eigen::Matrix3d turns = reported.covariance.block<3, 3>(3, 3);
  turns.diagonal() = reported.sigma_of_noise.segment<3>(3).cwiseAbs2();
  reported.base_turning_sigma = turning_sigma(turns, model.round_axes);
  reported.agreement = compared.total();
  reported.body_agreement = compared.bodies();
  reported.contour = compared.contour();
  reported.flush_bodies = objective.view().continued().flush_bodies();
  const ModelTerm::Totals& totals = objective.totals();
  reported.explained_points = totals.points;
  reported.residual_rms =
      totals.points > 0.0 ? std::sqrt(totals.weighted_squares / totals.points) : 0.0;
  reported.model_cost = solution.model_cost;
  reported.free_cost = solution.free_cost;
  reported.collision_cost = solution.collision_cost;
  reported.iterations = descended.iterations;
  reported.converged = descended.converged;
  reported.last_move = steps.moves().of_significant(descended.last_step, reported.observable,
                                                    reported.sigma_of_noise);
}

ArticulatedRegistration::ArticulatedRegistration(const ArticulatedModel& model,
                                                 const RegistrationOptions& options,
                                                 const Executor& executor)
    : stages_(std::make_unique<Stages>(model, options, executor)) {}

ArticulatedRegistration::~ArticulatedRegistration() = default;
ArticulatedRegistration::ArticulatedRegistration(ArticulatedRegistration&&) noexcept = default;
ArticulatedRegistration& ArticulatedRegistration::operator=(ArticulatedRegistration&&) noexcept =
    default;

RegistrationResult ArticulatedRegistration::align(const TiledCloud& cloud,
                                                  const Configuration& start,
                                                  const AlignOptions& align_options) {
  RegistrationResult result;
  align(cloud, start, align_options, result);
  return result;
}

void ArticulatedRegistration::align(const TiledCloud& cloud, const Configuration& start,
                                    const AlignOptions& align_options, RegistrationResult& result) {
  stages_->align(cloud, start, align_options, result);
}

SizeMeasurement ArticulatedRegistration::measure_size(const TiledCloud& cloud,
                                                      const Configuration& configuration) {
  if (!cloud.has_image()) return {};
  const PredictedView& view = stages_->objective.view_of(cloud, configuration);
  return stages_->size_meter.measure(view, cloud, configuration);
}

const RegistrationOptions& ArticulatedRegistration::options() const {
  return stages_->options;
}
const CollisionTerm& ArticulatedRegistration::collision() const {
  return stages_->objective.collision();
}
const ArticulatedModel& ArticulatedRegistration::model() const {
  return stages_->model;
}
const MotionMetric& ArticulatedRegistration::moves() const {
  return stages_->steps.moves();
}

}  // namespace lockbox
