// SPDX-License-Identifier: BSD-3-Clause
#include "descent.hpp"

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// Metres: a step that is as good as exact, a part of the noise of a single depth. Doubled, joints
/// that start 12 mm off come to rest up to 4 mm off (AlignmentTest.FromAPrediction...).
constexpr double kNearEnough = 0.001;
constexpr double kNearEnoughForFine = 0.004;  // the same, where the last iteration follows
constexpr int kMostFineIterations = 2;        // times the iterations, if more than a step is left
/// Trials of a damped step, where the whole one is none downhill. Source: not recorded. Doubled,
/// iterations that end a descent anyway cost five trials more.
constexpr int kMaxDampings = 5;
/// Of the curvature's diagonal, what the first of them adds to it, and how many times that of the
/// one before each further one adds. Source: not recorded. Doubled, steps are shorter than need be.
constexpr double kFirstDamping = 1e-2;
constexpr double kDampingGrowth = 10.0;

/// The share of the start's annealing sigma that iteration k of n still allows: 1 at first, 0 at
/// last.
double annealing_share(int k, int n) {
  if (n < 2) {
    return k == 0 ? 1.0 : 0.0;
  }
  const double rest = 1.0 - static_cast<double>(k) / (n - 1);
  return rest > 0.0 ? rest * rest : 0.0;
}

/// An iteration; false if it is to be the last.
bool report(const AlignOptions& align_options, bool is_narrow, Descended& found) {
  ++found.iterations;
  return !align_options.on_iteration || align_options.on_iteration(found.configuration, is_narrow);
}

}  // namespace

Descent::Descent(const RegistrationOptions& options, Objective& objective, Steps& steps)
    : step_tolerance_(options.step_tolerance), objective_(objective), steps_(steps) {}

void Descent::run(const Comparison* rough, const Comparison& close, const Configuration& start,
                  const AlignOptions& align_options, Linearization& at, Descended& found) {
  found.configuration = start;
  found.last_step.setZero(steps_.scale().unit.size());
  found.iterations = 0;
  found.converged = false;
  const bool is_coarse_to_fine = align_options.is_predicted && align_options.iterations > 1 &&
                                 objective_.sees_free_space(close.cloud);
  const Comparison& with = is_coarse_to_fine && rough != nullptr ? *rough : close;
  const int narrowing =
      align_options.narrowing > 0 ? align_options.narrowing : align_options.iterations;
  const auto annealing_sigma_of = [&](int k) {
    return k < align_options.iterations
               ? align_options.annealing_sigma * annealing_share(k, narrowing)
               : 0.0;
  };
  const int iterations = align_options.iterations - (is_coarse_to_fine ? 1 : 0);
  bool go_on = true;
  for (int k = 0; k < iterations && go_on; ++k) {
    objective_.linearize(with, found.configuration, annealing_sigma_of(k), at);
    const bool is_narrow = annealing_sigma_of(k) == 0.0;
    if (is_coarse_to_fine && steps_.add_short(at.all, align_options.hold_joints, kNearEnoughForFine,
                                              found.configuration)) {
      go_on = report(align_options, is_narrow, found);
      break;
    }
    const bool moved =
        improve(with, align_options.hold_joints, annealing_sigma_of(k + 1), at, found);
    found.converged = !moved && is_narrow;
    go_on = report(align_options, is_narrow, found) && !found.converged;
  }
  if (is_coarse_to_fine) run_fine_iterations(close, align_options, go_on, at, found);
}

/// The last iteration, of all points: mostly what is left is one step, as good as exact.
void Descent::run_fine_iterations(const Comparison& with, const AlignOptions& align_options,
                                  bool is_to_report, Linearization& at, Descended& found) {
  bool moves_on = true;
  for (int k = 0; k < kMostFineIterations * align_options.iterations && moves_on; ++k) {
    objective_.linearize(with, found.configuration, 0.0, at);
    const Eigen::VectorXd& step =
        steps_.best(at.all, found.configuration, align_options.hold_joints);
    moves_on = steps_.moves().of(step) > kNearEnough &&
               improve(with, align_options.hold_joints, 0.0, at, found);
  }
  found.converged = !moves_on;
  if (!moves_on) found.last_step.setZero();
  if (is_to_report) report(align_options, true, found);
}

void Descent::find_rest(const Descended& found, const Linearization& at, bool hold_joints,
                        Configuration& at_rest) {
  at_rest = found.configuration;
  steps_.add_short(at.all, hold_joints, kNearEnough, at_rest);
}

/// Takes the best acceptable step; false if there was none, or none worth taking. Mostly the first
/// trial is taken: then the next linearisation is made along with its cost.
bool Descent::improve(const Comparison& with, bool hold_joints, double next_sigma,
                      Linearization& at, Descended& found) {
  found.last_step.setZero();
  double damping = 0.0;
  for (int trial = 0; trial <= kMaxDampings; ++trial) {
    const Eigen::VectorXd& step = steps_.best(at.all, found.configuration, hold_joints, damping);
    if (!(steps_.moves().of(step) > step_tolerance_)) {
      return false;
    }
    candidate_ = found.configuration;
    apply_step(step, candidate_);
    const double cost = trial == 0 ? objective_.cost_ahead(with, candidate_, next_sigma, at)
                                   : objective_.cost(with, candidate_, at);
    if (cost < at.cost) {
      found.configuration = candidate_;
      found.last_step = step;
      return true;
    }
    damping = damping == 0.0 ? kFirstDamping : damping * kDampingGrowth;
  }
  return false;
}

}  // namespace lockbox
