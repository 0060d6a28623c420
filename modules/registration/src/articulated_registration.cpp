// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/articulated_registration.hpp"

#include <algorithm>
#include <cmath>

#include "descent.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/verification/agreement_meter.hpp"
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

/// The stages of an alignment, in the order in which align() calls them.
struct ArticulatedRegistration::Stages {
  Stages(const ArticulatedModel& of, const RegistrationOptions& how, const Executor& with)
      : model(of),
        options(how),
        executor(with),
        steps(of.tree, how),
        objective(of, how, steps.moves(), with),
        descent(how, objective, steps),
        outline_step(how, objective, steps),
        relief_step(of, how, objective, steps, with),
        edge_step(of, how, objective, steps, with),
        size_meter(of, how, steps) {
    options.locked.resize(static_cast<std::size_t>(of.tree.variables()), false);
  }

  const RegistrationResult& align(const TiledCloud& cloud, const Configuration& start,
                                  const Annealing& annealing);
  void refine_without_edges(const Configuration& start, const Annealing& annealing,
                            Linearization& solution);
  void estimate_covariance(const Linearization& solution);
  void compare_with_image(const Linearization& solution);
  void report(const Descended& descended, const Linearization& solution);

  const ArticulatedModel& model;
  RegistrationOptions options;
  Executor executor;
  Steps steps;
  Objective objective;
  Descent descent;
  OutlineStep outline_step;
  ReliefStep relief_step;
  EdgeStep edge_step;
  SizeMeter size_meter;
  AgreementMeter agreement;
  CovarianceEstimator covariance;

  Estimate estimate;
  BodyPoses poses;                ///< of the estimate
  std::vector<TileSystem> tiles;  ///< clusters of residuals
  RegistrationResult result;
};

const RegistrationResult& ArticulatedRegistration::Stages::align(const TiledCloud& cloud,
                                                                 const Configuration& start,
                                                                 const Annealing& annealing) {
  objective.begin(cloud, annealing);
  const Descended& descended = descent.run(start, annealing);
  // The covariance, and what the model explains, belong to the solution.
  Linearization& solution = objective.linearize(descended.configuration, 0.0);
  estimate.configuration = descended.configuration;
  descent.find_rest(solution, annealing.hold_joints, estimate.at_rest);
  refine_without_edges(start, annealing, solution);
  forward_kinematics(model.tree, estimate.configuration, poses);
  compare_with_image(solution);
  if (annealing.iterations > 0 && annealing.at_edges) {
    edge_step.take(poses, annealing.hold_joints, estimate, covariance);
  }
  covariance.add_floors(steps.moves().levers());
  report(descended, solution);
  return result;
}

void ArticulatedRegistration::Stages::refine_without_edges(const Configuration& start,
                                                           const Annealing& annealing,
                                                           Linearization& solution) {
  tiles.clear();
  objective.append_tile_systems(tiles);
  relief_step.skip();
  if (!objective.sees_free_space()) return;
  outline_step.take(solution, annealing.hold_joints, estimate, tiles);
  if (annealing.iterations > 0 && !annealing.hold_joints) {
    relief_step.take(start.q, solution, estimate);
  }
}

/// The consistency check, and the covariance along with it: neither needs the other.
void ArticulatedRegistration::Stages::compare_with_image(const Linearization& solution) {
  const PredictedView& view = objective.view();
  agreement.measure(model, view.surface(), view.samples(), poses, objective.cloud(), options,
                    executor, [&] { estimate_covariance(solution); });
}

/// Before edges add to it.
void ArticulatedRegistration::Stages::estimate_covariance(const Linearization& solution) {
  covariance.estimate(solution.data, tiles, options.noise_correlation, solution.jacobians,
                      steps.scale(), steps.held());
  const auto& sightings = relief_step.sightings();
  for (std::size_t v = 0; v < sightings.size(); ++v) {
    if (!sightings[v]) continue;
    covariance.set_independent(static_cast<Eigen::Index>(6 + v), sightings[v]->variance);
  }
}

void ArticulatedRegistration::Stages::report(const Descended& descended,
                                             const Linearization& solution) {
  result.configuration = estimate.configuration;
  result.at_rest = estimate.at_rest;
  result.covariance = covariance.covariance();
  result.sigma = covariance.sigma();
  result.sigma_of_noise = covariance.sigma_of_noise();
  result.observable = covariance.observable();
  Eigen::Matrix3d turns = result.covariance.block<3, 3>(3, 3);
  turns.diagonal() = result.sigma_of_noise.segment<3>(3).cwiseAbs2();
  result.base_turning_sigma = turning_sigma(turns, model.round_axes);
  result.agreement = agreement.total();
  result.body_agreement = agreement.bodies();
  result.outline = agreement.outline();
  result.flush_bodies = objective.view().continued().flush_bodies();
  const ModelTerm::Totals& totals = objective.totals();
  result.explained_points = totals.points;
  result.residual_rms =
      totals.points > 0.0 ? std::sqrt(totals.weighted_squares / totals.points) : 0.0;
  result.model_cost = solution.model_cost;
  result.free_cost = solution.free_cost;
  result.collision_cost = solution.collision_cost;
  result.iterations = descended.iterations;
  result.converged = descended.converged;
  result.last_move =
      steps.moves().of_significant(descended.last_step, result.observable, result.sigma_of_noise);
}

ArticulatedRegistration::ArticulatedRegistration(const ArticulatedModel& model,
                                                 const RegistrationOptions& options,
                                                 const Executor& executor)
    : stages_(std::make_unique<Stages>(model, options, executor)) {}

ArticulatedRegistration::~ArticulatedRegistration() = default;
ArticulatedRegistration::ArticulatedRegistration(ArticulatedRegistration&&) noexcept = default;
ArticulatedRegistration& ArticulatedRegistration::operator=(ArticulatedRegistration&&) noexcept =
    default;

const RegistrationResult& ArticulatedRegistration::align(const TiledCloud& cloud,
                                                         const Configuration& start,
                                                         const Annealing& annealing) {
  return stages_->align(cloud, start, annealing);
}

SizeMeasurement ArticulatedRegistration::measure_size(const Configuration& configuration) {
  Objective& objective = stages_->objective;
  if (!objective.cloud().has_image()) return {};
  return stages_->size_meter.measure(objective.view_of(configuration), objective.cloud(),
                                     configuration);
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
const SurfaceMoves& ArticulatedRegistration::moves() const {
  return stages_->steps.moves();
}

}  // namespace lockbox
