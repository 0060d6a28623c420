// SPDX-License-Identifier: BSD-3-Clause
#include "refinement.hpp"

#include <cmath>

#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/view/view_detail.hpp"

namespace lockbox {
namespace {

/// Points near edges, and contours, have told before part of what edges tell.
constexpr double kOverlap = 0.5;
constexpr double kPixelsOff = 2.0;      // that points and image may disagree by
constexpr double kMostObjection = 4.5;  // of cost: three standard deviations

}  // namespace

void ContourStep::take(const PinholeCamera& camera, bool hold_joints, SolutionSystem& solution,
                       Estimate& estimate) {
  const Eigen::VectorXd& step = steps_.best(solution.all, estimate.configuration, hold_joints);
  if (steps_.moves().of(step) > steps_.farthest_refinement(camera, estimate.configuration)) {
    estimate.configuration = estimate.at_rest;
    return;
  }
  apply_step(step, estimate.configuration);
  body_steps_.resize(solution.jacobians.size());
  for (std::size_t b = 0; b < solution.jacobians.size(); ++b) {
    body_steps_[b].noalias() = solution.jacobians[b] * step;
  }
  for (TileSystem& cluster : solution.clusters) {
    cluster.gradient.noalias() +=
        cluster.hessian * body_steps_[static_cast<std::size_t>(cluster.body)];
  }
}

ProminenceStep::ProminenceStep(const ArticulatedModel& model, const RegistrationOptions& options,
                               Objective& objective, const Steps& steps, const Executor& executor)
    : model_(model),
      options_(options),
      objective_(objective),
      steps_(steps),
      low_prominence_(model, options, executor) {}

void ProminenceStep::take(const Comparison& with, const Eigen::VectorXd& start,
                          const Linearization& at, SolutionSystem& solution, Estimate& estimate,
                          JointMatches& matches) {
  for (int v = 0; v < model_.tree.variables() && options_.match_low_prominence; ++v) {
    const double prominence = low_prominence_.prominence(v, estimate.configuration);
    if (prominence > LowProminence::kSurelyStandsOut ||
        steps_.held()[static_cast<std::size_t>(unknown_of(v))])
      continue;
    auto& match = matches[static_cast<std::size_t>(v)];
    match = low_prominence_.find_near(with.cloud, estimate.configuration, v, start[v]);
    if (prominence > options_.free_space_tolerance &&
        !is_elsewhere(with, estimate.configuration, v, match, at)) {
      match.reset();
      continue;
    }
    solution.forget(unknown_of(v));
    if (!match) continue;
    estimate.configuration.q[v] = match->position;
    estimate.at_rest.q[v] = match->position;
  }
}

/// Farther off than the image errs, and the other terms do not mind: points have pulled the joint
/// along. Where they do mind, what stands out far at places misleads the image, which takes a pixel
/// at an edge for the mean of both sides.
bool ProminenceStep::is_elsewhere(const Comparison& with, const Configuration& estimate,
                                  int variable, const std::optional<JointMatch>& match,
                                  const Linearization& at) {
  if (!match) return false;
  const double off = std::abs(match->position - estimate.q[variable]);
  const double pixel = low_prominence_.pixel_step(with.cloud.camera(), estimate, variable);
  if (off < kPixelsOff * pixel || off < options_.gate * std::sqrt(match->variance)) return false;
  candidate_ = estimate;
  candidate_.q[variable] = match->position;
  const double objection =
      objective_.cost(with, candidate_, at) - objective_.cost(with, estimate, at);
  return objection < kMostObjection;
}

EdgeStep::EdgeStep(const ArticulatedModel& model, const RegistrationOptions& options,
                   CollisionTerm& collision, Steps& steps, const Executor& executor)
    : model_(model),
      patches_per_joint_(
          options.refine_at_edges ? view_detail(options.point_budget).edge_patches_per_joint : 0),
      collision_(collision),
      steps_(steps),
      edges_(model.tree, options, executor) {}

void EdgeStep::take(const Comparison& with, const BodyPoses& poses, bool hold_joints,
                    Estimate& estimate, CovarianceEstimator& covariance) {
  const TiledCloud& cloud = with.cloud;
  if (patches_per_joint_ == 0 || !cloud.has_image()) return;
  const PredictedView& view = with.view;
  body_jacobians(model_.tree, poses, jacobians_);
  edges_.linearize(cloud, view.surface(), view.continued(), patches_per_joint_, poses, jacobians_);
  at_edges_.information = edges_.information();
  at_edges_.gradient = edges_.gradient();
  for (Eigen::Index i = 0; i < steps_.scale().unit.size(); ++i) {
    if (!covariance.determines(i)) at_edges_.forget(i);
  }
  all_.information = kOverlap * covariance.information() + at_edges_.information;
  all_.hessian = all_.information;
  all_.gradient = at_edges_.gradient;
  collision_.linearize(model_, poses, all_);
  const Eigen::VectorXd& step = steps_.best(all_, estimate.configuration, hold_joints);
  const double farthest = steps_.farthest_refinement(cloud.camera(), estimate.configuration);
  if (steps_.moves().of(step) > farthest) return;
  apply_step(step, estimate.configuration);
  at_edges_.information *= kOverlap;
  covariance.add_information(at_edges_.information);
}

}  // namespace lockbox
