// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/articulated_registration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

using Index = Eigen::Index;

/// Points that are enough to come near. Of as many as there may be only the last steps tell more.
constexpr std::size_t kApproachBudget = 3000;
constexpr ViewDetail kApproachDetail{2 * kApproachBudget, 4, 0};
constexpr double kNearEnough = 0.002;          // metres: a step that is as good as exact
constexpr double kNearEnoughToSettle = 0.004;  // the same, where the last iteration follows
constexpr int kMostToSettle = 2;               // times the iterations, if more than a step is left
constexpr double kStaleSelection = 0.0005;  // the same, until what is seen through is sought anew
constexpr double kNeverSelected = -1.0;
constexpr int kMaxDampings = 5;
constexpr double kFirstDamping = 1e-2;
constexpr double kDampingGrowth = 10.0;

/// The share of the start's spread that iteration k of n still allows: 1 at first, 0 at last.
double spread_share(int k, int n) {
  if (n < 2) {
    return k == 0 ? 1.0 : 0.0;
  }
  const double rest = 1.0 - static_cast<double>(k) / (n - 1);
  return rest > 0.0 ? rest * rest : 0.0;
}

}  // namespace

ArticulatedRegistration::ArticulatedRegistration(const ArticulatedModel& model,
                                                 const RegistrationOptions& options,
                                                 const Executor& executor)
    : model_(model),
      options_(options),
      executor_(executor),
      collision_(model, options, executor),
      low_relief_(model, options, executor),
      edges_(model.tree, options, executor),
      approach_view_(kApproachBudget, kApproachDetail),
      full_view_(options.point_budget, view_detail(options.point_budget)),
      scale_(step_scale(model.tree)),
      moves_(model.tree) {
  options_.locked.resize(static_cast<std::size_t>(model.tree.variables()), false);
  systems_.resize(model.tree.bodies.size());
  held_.assign(static_cast<std::size_t>(scale_.unit.size()), false);
  std::fill_n(held_.begin(), 6, options_.fixed_base);
  std::copy(options_.locked.begin(), options_.locked.end(), held_.begin() + 6);
}

const RegistrationResult& ArticulatedRegistration::align(const TiledCloud& cloud,
                                                         const Configuration& start,
                                                         const Annealing& annealing) {
  result_.configuration = start;
  start_ = start.q;
  is_predicted_ = annealing.is_predicted;
  sightings_.assign(static_cast<std::size_t>(model_.tree.variables()), std::nullopt);
  result_.converged = false;
  result_.iterations = 0;
  last_step_.setZero(scale_.unit.size());
  linearized_spread_.reset();
  ahead_spread_.reset();
  if (!annealing.goes_on) {
    selected_spread_ = kNeverSelected;
    approach_view_.forget();
    full_view_.forget();
  }
  descend(cloud, annealing);
  // The covariance, and what the model explains, belong to the solution.
  linearize(cloud, 0.0);
  find_rest(annealing.hold_joints);
  tile_systems_.clear();
  model_term_.append_tile_systems(tile_systems_);
  if (takes_last_steps(cloud)) {
    refine(cloud.camera(), annealing.hold_joints);
    if (annealing.iterations > 0 && !annealing.hold_joints) sight_low_relief(cloud);
  }
  forward_kinematics(model_.tree, result_.configuration, poses_);
  agreement_.measure(model_, view_->surface(), view_->samples(), poses_, cloud, options_, executor_,
                     [&] { estimate_covariance(); });
  if (annealing.iterations > 0 && annealing.at_edges) {
    refine_at_edges(cloud, annealing.hold_joints);
  }
  covariance_.add_floors(moves_.levers());
  result_.covariance = covariance_.covariance();
  result_.sigma = covariance_.sigma();
  result_.sigma_of_noise = covariance_.sigma_of_noise();
  result_.observable = covariance_.observable();
  result_.last_move = moves_.of_significant(last_step_, result_.observable, result_.sigma_of_noise);
  result_.agreement = agreement_.total();
  result_.body_agreement = agreement_.bodies();
  result_.outline = agreement_.outline();
  result_.flush_bodies = view_->continued().flush_bodies();
  const ModelTerm::Totals& totals = model_term_.totals();
  result_.explained_points = totals.points;
  result_.residual_rms =
      totals.points > 0.0 ? std::sqrt(totals.weighted_squares / totals.points) : 0.0;
  return result_;
}

/// The descent. From a prediction, a few of many points are enough to come near, and near is where
/// what is left is settled.
void ArticulatedRegistration::descend(const TiledCloud& cloud, const Annealing& annealing) {
  const bool settles =
      annealing.is_predicted && annealing.iterations > 1 && takes_last_steps(cloud);
  const std::size_t budget = options_.point_budget;
  const bool is_thinned = settles && (budget == 0 || budget > kApproachBudget);
  look_through(is_thinned ? approach_view_ : full_view_);
  const int narrowing = annealing.narrowing > 0 ? annealing.narrowing : annealing.iterations;
  const auto spread_of = [&](int k) {
    return k < annealing.iterations ? annealing.spread * spread_share(k, narrowing) : 0.0;
  };
  const int iterations = annealing.iterations - (settles ? 1 : 0);
  bool go_on = true;
  for (int k = 0; k < iterations && go_on; ++k) {
    const double cost = linearize(cloud, spread_of(k));
    const bool is_narrow = spread_of(k) == 0.0;
    if (settles &&
        add_short_step(annealing.hold_joints, kNearEnoughToSettle, result_.configuration)) {
      linearized_spread_.reset();
      go_on = report(annealing, is_narrow);
      break;
    }
    const bool moved = improve(cloud, cost, annealing.hold_joints, spread_of(k + 1));
    result_.converged = !moved && is_narrow;
    go_on = report(annealing, is_narrow) && !result_.converged;
  }
  if (settles) settle(cloud, annealing, go_on);
}

/// Adds the next one without a trial; false if it moves surfaces farther than this, metres.
bool ArticulatedRegistration::add_short_step(bool hold_joints, double farthest,
                                             Configuration& configuration) {
  const Eigen::VectorXd& step = next_step(hold_joints);
  if (!(moves_.of(step) <= farthest)) return false;
  apply_step(step, configuration);
  return true;
}

/// The last iteration, of all points: mostly what is left is one step, as good as exact.
void ArticulatedRegistration::settle(const TiledCloud& cloud, const Annealing& annealing,
                                     bool is_to_report) {
  look_through(full_view_);
  bool moves_on = true;
  for (int k = 0; k < kMostToSettle * annealing.iterations && moves_on; ++k) {
    const double cost = linearize(cloud, 0.0);
    moves_on = moves_.of(next_step(annealing.hold_joints)) > kNearEnough &&
               improve(cloud, cost, annealing.hold_joints, 0.0);
  }
  result_.converged = !moves_on;
  if (!moves_on) last_step_.setZero();
  if (is_to_report) report(annealing, true);
}

/// The undamped one, from the last linearisation.
const Eigen::VectorXd& ArticulatedRegistration::next_step(bool hold_joints) {
  set_step_limits(hold_joints);
  return solver_.solve(equations_, 0.0, limits_, scale_);
}

/// Where the descent would end, if it is near.
void ArticulatedRegistration::find_rest(bool hold_joints) {
  result_.at_rest = result_.configuration;
  add_short_step(hold_joints, kNearEnough, result_.at_rest);
}

/// An iteration; false if it is to be the last.
bool ArticulatedRegistration::report(const Annealing& annealing, bool is_narrow) {
  ++result_.iterations;
  return !annealing.on_iteration || annealing.on_iteration(result_.configuration, is_narrow);
}

void ArticulatedRegistration::look_through(PredictedView& view) {
  if (view_ == &view) return;
  view_ = &view;
  selected_spread_ = kNeverSelected;
  linearized_spread_.reset();
  ahead_spread_.reset();
}

ModelTerm::Scene ArticulatedRegistration::scene(const TiledCloud& cloud) const {
  return {model_, view_->points(), cloud.camera(), view_->prediction(), options_, executor_};
}

double ArticulatedRegistration::linearize(const TiledCloud& cloud, double spread) {
  if (linearized_spread_ == spread) return cost_;  // the last step was not taken
  if (!view_->shows(result_.configuration, moves_)) {
    view_->look_at(cloud, model_, result_.configuration, options_.cut * spread, is_predicted_,
                   options_, executor_);
  }
  forward_kinematics(model_.tree, result_.configuration, poses_);
  body_jacobians(model_.tree, poses_, jacobians_);
  std::fill(systems_.begin(), systems_.end(), BodySystem{});
  linearize_at_points(cloud, spread);
  result_.free_cost = 0.0;
  if (options_.lambda_free > 0.0 && cloud.has_image()) {
    select_free_space(cloud, spread);
    result_.free_cost = free_term_.linearize(poses_, spread, systems_);
  }
  data_equations_.set_zero(scale_.unit.size());
  for (std::size_t b = 0; b < systems_.size(); ++b) {
    data_equations_.add(systems_[b], jacobians_[b], 1.0 / options_.noise_correlation);
  }
  equations_ = data_equations_;
  result_.collision_cost = collision_.sum_up(model_, poses_, &equations_);
  linearized_spread_ = spread;
  cost_ = (result_.model_cost + result_.free_cost) / options_.noise_correlation +
          result_.collision_cost;
  return cost_;
}

/// The model term, and collisions along with it.
void ArticulatedRegistration::linearize_at_points(const TiledCloud& cloud, double spread) {
  const auto collide = [&](std::size_t i) { collision_.evaluate_part(model_, poses_, i); };
  const Loop collisions{collision_.begin(poses_), collide};
  if (ahead_spread_ == spread) {
    result_.model_cost = model_term_.take_ahead(systems_);
    executor_.for_each({collisions});
  } else {
    result_.model_cost = model_term_.linearize(scene(cloud), poses_, spread, systems_, collisions);
  }
  ahead_spread_.reset();
}

/// A selection lasts while the configuration stays where it was made: selecting anew at each
/// iteration would never let the last steps come to rest.
void ArticulatedRegistration::select_free_space(const TiledCloud& cloud, double spread) {
  if (spread <= selected_spread_ &&
      moves_.between(selected_, result_.configuration) < kStaleSelection) {
    return;
  }
  free_term_.select({model_, view_->surface(), view_->samples(), view_->outlines(),
                     view_->continued(), cloud, options_, executor_},
                    poses_, spread);
  selected_ = result_.configuration;
  selected_spread_ = spread;
}

/// With next_spread, the model term is linearised there on the way.
double ArticulatedRegistration::cost_at(const TiledCloud& cloud, const Configuration& configuration,
                                        std::optional<double> next_spread) {
  forward_kinematics(model_.tree, configuration, trial_poses_);
  const auto collide = [&](std::size_t i) { collision_.evaluate_part(model_, trial_poses_, i); };
  const Loop collisions{collision_.begin(trial_poses_), collide};
  const ModelTerm::Scene seen = scene(cloud);
  double cost = next_spread ? model_term_.cost_ahead(seen, trial_poses_, *next_spread, collisions)
                            : model_term_.cost(seen, trial_poses_, collisions);
  if (options_.lambda_free > 0.0 && cloud.has_image()) cost += free_term_.cost(trial_poses_);
  return cost / options_.noise_correlation + collision_.sum_up(model_, trial_poses_, nullptr);
}

/// Takes the best acceptable step; false if there was none, or none worth taking. Mostly the first
/// trial is taken: unless the model has to be drawn anew then, the next linearisation is made along
/// with its cost.
bool ArticulatedRegistration::improve(const TiledCloud& cloud, double cost, bool hold_joints,
                                      double next_spread) {
  set_step_limits(hold_joints);
  last_step_.setZero();
  double damping = 0.0;
  for (int trial = 0; trial <= kMaxDampings; ++trial) {
    const Eigen::VectorXd& step = solver_.solve(equations_, damping, limits_, scale_);
    if (!(moves_.of(step) > options_.step_tolerance)) {
      return false;
    }
    candidate_ = result_.configuration;
    apply_step(step, candidate_);
    const bool looks_ahead = trial == 0 && view_->shows(candidate_, moves_);
    const auto spread_ahead = looks_ahead ? std::optional(next_spread) : std::nullopt;
    if (cost_at(cloud, candidate_, spread_ahead) < cost) {
      result_.configuration = candidate_;
      last_step_ = step;
      linearized_spread_.reset();
      ahead_spread_ = spread_ahead;
      return true;
    }
    damping = damping == 0.0 ? kFirstDamping : damping * kDampingGrowth;
  }
  return false;
}

void ArticulatedRegistration::set_step_limits(bool hold_joints) {
  const Index n = scale_.unit.size();
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  limits_.lower.setConstant(n, options_.fixed_base ? 0.0 : -kUnlimited);
  limits_.upper.setConstant(n, options_.fixed_base ? 0.0 : kUnlimited);
  for (int v = 0; v < model_.tree.variables(); ++v) {
    const VariableLimits range = variable_limits(model_.tree, v);
    const double q = result_.configuration.q[v];
    const bool locked = hold_joints || options_.locked[static_cast<std::size_t>(v)];
    limits_.lower[6 + v] = locked ? 0.0 : std::min(0.0, range.lower - q);
    limits_.upper[6 + v] = locked ? 0.0 : std::max(0.0, range.upper - q);
  }
}

}  // namespace lockbox
