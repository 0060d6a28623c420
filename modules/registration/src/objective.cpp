// SPDX-License-Identifier: BSD-3-Clause
#include "objective.hpp"

#include <algorithm>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/view/view_detail.hpp"

namespace lockbox {
namespace {

/// Points that are enough to come near. Of as many as there may be only the last steps tell more.
constexpr std::size_t kApproachBudget = 3000;
constexpr ViewDetail kApproachDetail{2 * kApproachBudget, 4, 0};
constexpr double kStaleSelection = 0.0005;  // metres, until what is seen through is sought anew

}  // namespace

void Linearization::forget(Eigen::Index unknown) {
  data.forget(unknown);
  for (BodyJacobian& jacobian : jacobians) jacobian.col(unknown).setZero();
}

bool Objective::Place::is(const Configuration& other, double other_sigma) const {
  return annealing_sigma == other_sigma && configuration.q == other.q &&
         configuration.T_camera_base.matrix() == other.T_camera_base.matrix();
}

void Objective::Place::set(const Configuration& other, double other_sigma) {
  configuration = other;
  annealing_sigma = other_sigma;
}

Objective::Objective(const ArticulatedModel& model, const RegistrationOptions& options,
                     const MotionMetric& moves, const Executor& executor)
    : model_(model),
      options_(options),
      moves_(moves),
      executor_(executor),
      collision_(model, options, executor),
      approach_view_(kApproachBudget, kApproachDetail),
      full_view_(options.point_budget, view_detail(options.point_budget)),
      other_view_(options.point_budget, view_detail(options.point_budget)) {
  systems_.resize(model.tree.bodies.size());
}

void Objective::begin(const TiledCloud& cloud, const AlignOptions& align_options) {
  cloud_ = &cloud;
  is_predicted_ = align_options.is_predicted;
  forget_linearizations();
  if (!align_options.goes_on) {
    selected_.annealing_sigma.reset();
    approach_view_.forget();
    full_view_.forget();
  }
}

bool Objective::sees_free_space() const {
  return options_.lambda_free > 0.0 && cloud_->has_image();
}

bool Objective::has_rough_view() const {
  return options_.point_budget == 0 || options_.point_budget > kApproachBudget;
}

void Objective::look_through(PredictedView& view) {
  if (view_ == &view) return;
  view_ = &view;
  selected_.annealing_sigma.reset();
  forget_linearizations();
}

void Objective::forget_linearizations() {
  linearized_.annealing_sigma.reset();
  ahead_.annealing_sigma.reset();
}

ModelTerm::Scene Objective::scene() const {
  return {model_, view_->points(), cloud_->camera(), view_->prediction(), options_, executor_};
}

void Objective::look_at(const Configuration& configuration, double annealing_sigma) {
  if (view_->shows(configuration, moves_)) return;
  view_->look_at(*cloud_, model_, configuration, options_.gate * annealing_sigma, is_predicted_,
                 options_, executor_);
}

const PredictedView& Objective::view_of(const TiledCloud& cloud,
                                        const Configuration& configuration) {
  if (&cloud != cloud_) {
    other_view_.look_at(cloud, model_, configuration, 0.0, false, options_, executor_);
    return other_view_;
  }
  look_at(configuration, 0.0);
  return *view_;
}

Linearization& Objective::linearize(const Configuration& configuration, double annealing_sigma) {
  Linearization& at = linearization_;
  if (linearized_.is(configuration, annealing_sigma)) return at;  // the last step was not taken
  look_at(configuration, annealing_sigma);
  forward_kinematics(model_.tree, configuration, at.poses);
  body_jacobians(model_.tree, at.poses, at.jacobians);
  std::fill(systems_.begin(), systems_.end(), BodySystem{});
  linearize_points(configuration, annealing_sigma);
  at.free_cost = 0.0;
  if (sees_free_space()) {
    select_free_space(configuration, annealing_sigma);
    at.free_cost = free_term_.linearize(at.poses, annealing_sigma, systems_);
  }
  at.data.set_zero(6 + model_.tree.variables());
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    at.data.add(systems_[b], at.jacobians[b], 1.0 / options_.noise_correlation);
  }
  at.all = at.data;
  at.collision_cost = collision_.sum_up(model_, at.poses, &at.all);
  at.cost = (at.model_cost + at.free_cost) / options_.noise_correlation + at.collision_cost;
  linearized_.set(configuration, annealing_sigma);
  return at;
}

/// The model term, and collisions along with it.
void Objective::linearize_points(const Configuration& configuration, double annealing_sigma) {
  Linearization& at = linearization_;
  const auto collide = [&](std::size_t i) { collision_.evaluate_part(model_, at.poses, i); };
  const Loop collisions{collision_.begin(at.poses), collide};
  if (ahead_.is(configuration, annealing_sigma)) {
    at.model_cost = model_term_.take_ahead(systems_);
    executor_.for_each({collisions});
  } else {
    at.model_cost = model_term_.linearize(scene(), at.poses, annealing_sigma, systems_, collisions);
  }
  ahead_.annealing_sigma.reset();
}

/// A selection lasts while the configuration stays where it was made: selecting anew at each
/// iteration would never let the last steps come to rest.
void Objective::select_free_space(const Configuration& configuration, double annealing_sigma) {
  if (selected_.annealing_sigma && annealing_sigma <= *selected_.annealing_sigma &&
      moves_.between(selected_.configuration, configuration) < kStaleSelection) {
    return;
  }
  free_term_.select({model_, view_->surface(), view_->samples(), view_->contours(),
                     view_->continued(), *cloud_, options_, executor_},
                    linearization_.poses, annealing_sigma);
  selected_.set(configuration, annealing_sigma);
}

double Objective::cost(const Configuration& configuration, std::optional<double> next_sigma) {
  if (next_sigma && !view_->shows(configuration, moves_)) next_sigma.reset();
  forward_kinematics(model_.tree, configuration, trial_poses_);
  const auto collide = [&](std::size_t i) { collision_.evaluate_part(model_, trial_poses_, i); };
  const Loop collisions{collision_.begin(trial_poses_), collide};
  double cost = next_sigma ? model_term_.cost_ahead(scene(), trial_poses_, *next_sigma, collisions)
                           : model_term_.cost(scene(), trial_poses_, collisions);
  if (next_sigma) ahead_.set(configuration, *next_sigma);
  if (sees_free_space()) cost += free_term_.cost(trial_poses_);
  return cost / options_.noise_correlation + collision_.sum_up(model_, trial_poses_, nullptr);
}

void Objective::append_tile_systems(std::vector<TileSystem>& systems) const {
  model_term_.append_tile_systems(systems);
}

void Objective::weigh_contours(double weight, std::vector<TileSystem>& systems) {
  Linearization& at = linearization_;
  std::fill(systems_.begin(), systems_.end(), BodySystem{});
  free_term_.add_contours(weight - options_.lambda_free, systems_);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    for (NormalEquations* equations : {&at.data, &at.all}) {
      equations->add(systems_[b], at.jacobians[b], 1.0 / options_.noise_correlation);
    }
  }
  const std::size_t first_tile = view_->has_own_tiles() ? view_->points().tiles().size() : 0;
  free_term_.append_tile_systems(at.poses, first_tile, weight, executor_, systems);
}

}  // namespace lockbox
