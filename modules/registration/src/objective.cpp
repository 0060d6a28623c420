// SPDX-License-Identifier: BSD-3-Clause
#include "objective.hpp"

#include <algorithm>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

constexpr double kStaleSelection = 0.0005;  // metres, until what is seen through is sought anew

}  // namespace

Objective::Objective(const ArticulatedModel& model, const RegistrationOptions& options,
                     const MotionMetric& moves, const Executor& executor)
    : model_(model),
      options_(options),
      moves_(moves),
      executor_(executor),
      collision_(model, options, executor),
      systems_(model.tree.bodies.size()) {}

bool Objective::sees_free_space(const TiledCloud& cloud) const {
  return options_.lambda_free > 0.0 && cloud.has_image();
}

ModelTerm::Scene Objective::scene(const Comparison& with) const {
  return {model_,   with.view.points(), with.cloud.camera(), with.view.prediction(),
          options_, executor_};
}

void Objective::draw(const Comparison& with, const Configuration& configuration,
                     double annealing_sigma) const {
  if (with.view.shows(configuration, moves_)) return;
  with.view.look_at(with.cloud, model_, configuration, options_.gate * annealing_sigma,
                    with.is_predicted, options_, executor_);
}

void Objective::linearize(const Comparison& with, const Configuration& configuration,
                          double annealing_sigma, Linearization& at) {
  // The last step was not taken.
  if (at.linearized_at.is(with.view, configuration, annealing_sigma)) return;
  draw(with, configuration, annealing_sigma);
  forward_kinematics(model_.tree, configuration, at.poses);
  body_jacobians(model_.tree, at.poses, at.jacobians);
  std::fill(systems_.begin(), systems_.end(), BodySystem{});
  linearize_points(with, configuration, annealing_sigma, at);
  at.free_cost = 0.0;
  if (sees_free_space(with.cloud)) {
    select_free_space(with, configuration, annealing_sigma, at);
    at.free_cost = at.free_term.linearize(at.poses, annealing_sigma, systems_);
  }
  at.data.set_zero(model_.tree.unknowns());
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    at.data.add(systems_[b], at.jacobians[b], 1.0 / options_.noise_correlation);
  }
  at.all = at.data;
  at.collision_cost = collision_.sum_up(model_, at.poses, &at.all);
  at.cost = (at.model_cost + at.free_cost) / options_.noise_correlation + at.collision_cost;
  at.linearized_at.set(with.view, configuration, annealing_sigma);
}

/// The model term, and collisions along with it.
void Objective::linearize_points(const Comparison& with, const Configuration& configuration,
                                 double annealing_sigma, Linearization& at) {
  const auto collide = [&](std::size_t i) { collision_.evaluate_part(model_, at.poses, i); };
  const Loop collisions{collision_.begin(at.poses), collide};
  if (at.ahead_at.is(with.view, configuration, annealing_sigma)) {
    at.model_cost = at.model_term.take_ahead(systems_);
    executor_.for_each({collisions});
  } else {
    at.model_cost =
        at.model_term.linearize(scene(with), at.poses, annealing_sigma, systems_, collisions);
  }
  at.ahead_at.forget();
  at.totals = at.model_term.totals();
}

/// A selection lasts while the configuration stays where it was made: selecting anew at each
/// iteration would never let the last steps come to rest.
void Objective::select_free_space(const Comparison& with, const Configuration& configuration,
                                  double annealing_sigma, Linearization& at) const {
  const PredictedView& view = with.view;
  if (at.selected_at.is_near(view, configuration, annealing_sigma, kStaleSelection, moves_)) return;
  at.free_term.select({model_, view.surface(), view.samples(), view.contours(), view.continued(),
                       with.cloud, options_, executor_},
                      at.poses, annealing_sigma);
  at.selected_at.set(view, configuration, annealing_sigma);
}

/// cost_of_points: at the trial's poses, with collisions in the same loop.
template <typename PointCost>
double Objective::cost_with(const Comparison& with, const Configuration& configuration,
                            const FreeSpaceTerm& free_term, PointCost&& cost_of_points) {
  forward_kinematics(model_.tree, configuration, trial_poses_);
  const auto collide = [&](std::size_t i) { collision_.evaluate_part(model_, trial_poses_, i); };
  double cost = cost_of_points(Loop{collision_.begin(trial_poses_), collide});
  if (sees_free_space(with.cloud)) cost += free_term.cost(trial_poses_);
  return cost / options_.noise_correlation + collision_.sum_up(model_, trial_poses_, nullptr);
}

double Objective::cost(const Comparison& with, const Configuration& configuration,
                       const Linearization& under) {
  return cost_with(with, configuration, under.free_term, [&](const Loop& collisions) {
    return under.model_term.cost(scene(with), trial_poses_, collisions);
  });
}

double Objective::cost_ahead(const Comparison& with, const Configuration& configuration,
                             double next_sigma, Linearization& under) {
  if (!with.view.shows(configuration, moves_)) return cost(with, configuration, under);
  under.ahead_at.set(with.view, configuration, next_sigma);
  return cost_with(with, configuration, under.free_term, [&](const Loop& collisions) {
    return under.model_term.cost_ahead(scene(with), trial_poses_, next_sigma, collisions);
  });
}

void Objective::weigh_solution(const Comparison& with, const Linearization& at,
                               SolutionSystem& solution) {
  solution.jacobians = at.jacobians;
  solution.data = at.data;
  solution.all = at.all;
  solution.clusters.clear();
  at.model_term.append_tile_systems(solution.clusters);
  if (!sees_free_space(with.cloud)) return;
  const double weight = options_.noise_correlation / options_.contour_correlation;
  std::fill(systems_.begin(), systems_.end(), BodySystem{});
  at.free_term.add_contours(weight - options_.lambda_free, systems_);
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    for (NormalEquations* equations : {&solution.data, &solution.all}) {
      equations->add(systems_[b], at.jacobians[b], 1.0 / options_.noise_correlation);
    }
  }
  const std::size_t first_tile = with.view.has_own_tiles() ? with.view.points().tiles().size() : 0;
  at.free_term.append_tile_systems(at.poses, first_tile, weight, executor_, solution.clusters);
}

}  // namespace lockbox
