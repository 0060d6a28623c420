// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/articulated_registration.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "descent.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/verification/consistency_check.hpp"
#include "refinement.hpp"
#include "size_meter.hpp"

namespace lockbox {
namespace {

/// Returns the deviation of turns that change what is seen: not about the axes, of which two or
/// more are those of a ball.
double turning_sigma(const Eigen::Matrix3d& covariance,
                     const std::vector<Eigen::Vector3d>& round_axes) {
  if (round_axes.size() > 1) return 0.0;
  Eigen::Matrix3d across = Eigen::Matrix3d::Identity();
  for (const Eigen::Vector3d& axis : round_axes) across -= axis * axis.transpose();
  return std::sqrt(std::max(0.0, (across * covariance * across).trace()));
}

}  // namespace

/// The stages of an alignment, in the order in which align() calls them. What a stage reads and
/// what it changes are its parameters: none sets what another reads, but in what it is given.
struct ArticulatedRegistration::Stages {
  Stages(const ArticulatedModel& of, const RegistrationOptions& how, const Executor& with)
      : model(of),
        options(how),
        executor(with),
        steps(of.tree, how),
        objective(of, how, steps.moves(), with),
        descent(how, objective, steps),
        contour_step(steps),
        prominence_step(of, how, objective, steps, with),
        edge_step(of, how, objective.collision(), steps, with),
        size_meter(of, how, steps),
        views(how) {
    options.locked.resize(static_cast<std::size_t>(of.tree.variables()), false);
  }

  void align(const TiledCloud& cloud, const Configuration& start, const AlignOptions& align_options,
             RegistrationResult& result);
  SizeMeasurement measure_size(const TiledCloud& cloud, const Configuration& configuration);

  /// Steps by contours and by low prominence. at: where the descent has ended.
  void refine_without_edges(const Comparison& with, const Configuration& start,
                            const AlignOptions& align_options, const Linearization& at,
                            SolutionSystem& system, Estimate& refined, JointMatches& seen);
  /// Estimates the covariance before edges add to it.
  void estimate_covariance(const SolutionSystem& system, const JointMatches& seen,
                           CovarianceEstimator& estimated) const;
  /// The consistency check; meanwhile: what is done along with it.
  void compare_with_image(const Comparison& with, const BodyPoses& at,
                          FunctionRef<void()> meanwhile, ConsistencyCheck& compared) const;
  void report(const Comparison& with, const Descended& ended, const Linearization& at,
              const Estimate& refined, const CovarianceEstimator& estimated,
              const ConsistencyCheck& compared, RegistrationResult& reported) const;

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

  // What outlasts an alignment, for one that goes on, and for measure_size().
  Views views;
  Linearization linearization;
  std::optional<Comparison> last;  ///< none: there was no alignment

  // Memory of what the stages hand on, and nothing else.
  Descended descended;
  SolutionSystem solution;
  Estimate estimate;
  BodyPoses poses;  ///< of the estimate
  JointMatches matches;
  ConsistencyCheck agreement;
  CovarianceEstimator covariance;
};

void ArticulatedRegistration::Stages::align(const TiledCloud& cloud, const Configuration& start,
                                            const AlignOptions& align_options,
                                            RegistrationResult& result) {
  if (!align_options.goes_on) views.forget();
  linearization.begin(align_options.goes_on);
  const Comparison rough{cloud, views.rough, align_options.is_predicted};
  const Comparison& close =
      last.emplace(Comparison{cloud, views.close, align_options.is_predicted});
  descent.run(views.has_rough ? &rough : nullptr, close, start, align_options, linearization,
              descended);
  // The covariance, and what the model explains, belong to the solution.
  objective.linearize(close, descended.configuration, 0.0, linearization);
  estimate.configuration = descended.configuration;
  descent.find_rest(descended, linearization, align_options.hold_joints, estimate.at_rest);
  objective.weigh_solution(close, linearization, solution);
  refine_without_edges(close, start, align_options, linearization, solution, estimate, matches);
  forward_kinematics(model.tree, estimate.configuration, poses);
  // Neither needs the other.
  const auto covariance_of_points = [&] { estimate_covariance(solution, matches, covariance); };
  compare_with_image(close, poses, covariance_of_points, agreement);
  if (align_options.iterations > 0 && align_options.at_edges) {
    edge_step.take(close, poses, align_options.hold_joints, estimate, covariance);
  }
  covariance.add_floors(steps.moves().scales());
  report(close, descended, linearization, estimate, covariance, agreement, result);
}

SizeMeasurement ArticulatedRegistration::Stages::measure_size(const TiledCloud& cloud,
                                                              const Configuration& configuration) {
  if (!cloud.has_image()) return {};
  const bool is_drawn = last && &last->cloud == &cloud;
  if (!is_drawn) views.other.forget();
  const Comparison with = is_drawn ? *last : Comparison{cloud, views.other, false};
  objective.draw(with, configuration, 0.0);
  return size_meter.measure(with.view, cloud, configuration);
}

void ArticulatedRegistration::Stages::refine_without_edges(
    const Comparison& with, const Configuration& start, const AlignOptions& align_options,
    const Linearization& at, SolutionSystem& system, Estimate& refined, JointMatches& seen) {
  seen.assign(static_cast<std::size_t>(model.tree.variables()), std::nullopt);
  if (!objective.sees_free_space(with.cloud)) return;
  contour_step.take(with.cloud.camera(), align_options.hold_joints, system, refined);
  if (align_options.iterations > 0 && !align_options.hold_joints) {
    prominence_step.take(with, start.q, at, system, refined, seen);
  }
}

void ArticulatedRegistration::Stages::compare_with_image(const Comparison& with,
                                                         const BodyPoses& at,
                                                         FunctionRef<void()> meanwhile,
                                                         ConsistencyCheck& compared) const {
  compared.measure(model, with.view.surface(), with.view.samples(), at, with.cloud, options,
                   executor, meanwhile);
}

void ArticulatedRegistration::Stages::estimate_covariance(const SolutionSystem& system,
                                                          const JointMatches& seen,
                                                          CovarianceEstimator& estimated) const {
  estimated.estimate(system.data, system.clusters, options.noise_correlation, system.jacobians,
                     steps.scale(), steps.held());
  for (int v = 0; v < model.tree.variables(); ++v) {
    const std::optional<JointMatch>& match = seen[static_cast<std::size_t>(v)];
    if (match) estimated.set_independent(unknown_of(v), match->variance);
  }
}

void ArticulatedRegistration::Stages::report(const Comparison& with, const Descended& ended,
                                             const Linearization& at, const Estimate& refined,
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
  reported.flush_bodies = with.view.continued().flush_bodies();
  const ModelTerm::Totals& totals = at.totals;
  reported.explained_points = totals.points;
  reported.residual_rms =
      totals.points > 0.0 ? std::sqrt(totals.weighted_squares / totals.points) : 0.0;
  reported.model_cost = at.model_cost;
  reported.free_cost = at.free_cost;
  reported.collision_cost = at.collision_cost;
  reported.iterations = ended.iterations;
  reported.converged = ended.converged;
  reported.last_move =
      steps.moves().of_significant(ended.last_step, reported.observable, reported.sigma_of_noise);
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
  return stages_->measure_size(cloud, configuration);
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
