// SPDX-License-Identifier: BSD-3-Clause
// The descent: Levenberg-Marquardt while gates narrow. An iteration is one linearisation; its first
// trial is undamped.
#pragma once

#include "objective.hpp"
#include "steps.hpp"

namespace lockbox {

/// Where a descent has ended.
struct Descended {
  Configuration configuration;
  Eigen::VectorXd last_step;  ///< zero if the last iteration found none worth taking
  int iterations = 0;
  bool converged = false;
};

class Descent {
 public:
  /// Objective and steps must outlive it.
  Descent(const RegistrationOptions& options, Objective& objective, Steps& steps);

  /// Descends from the start to `found`. From a prediction, a few of many points are enough to come
  /// near (rough; none: there are no fewer points), and near is where what is left is settled
  /// (close). at: begun with this cloud; it stays at the last linearisation.
  void run(const Comparison* rough, const Comparison& close, const Configuration& start,
           const AlignOptions& align_options, Linearization& at, Descended& found);

  /// Where it would have ended, if that is near. at: linearised where it did end.
  void find_rest(const Descended& found, const Linearization& at, bool hold_joints,
                 Configuration& at_rest);

 private:
  void run_fine_iterations(const Comparison& with, const AlignOptions& align_options,
                           bool is_to_report, Linearization& at, Descended& found);
  bool improve(const Comparison& with, bool hold_joints, double next_sigma, Linearization& at,
               Descended& found);

  double step_tolerance_;  ///< metres
  Objective& objective_;
  Steps& steps_;
  Configuration candidate_;  ///< memory
};

}  // namespace lockbox
