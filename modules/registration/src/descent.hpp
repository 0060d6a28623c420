// SPDX-License-Identifier: BSD-3-Clause
// The descent: Levenberg-Marquardt while gates narrow. An iteration is one linearisation; its first
// trial is undamped.
#pragma once

#include "objective.hpp"
#include "steps.hpp"

namespace lockbox {

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

  /// In the cloud that the objective has begun with. Valid until the next call. From a prediction,
  /// a few of many points are enough to come near, and near is where what is left is settled.
  const Descended& run(const Configuration& start, const AlignOptions& align_options);

  /// Where it would have ended, if that is near; at: linearised where it did end.
  void find_rest(const Linearization& at, bool hold_joints, Configuration& at_rest);

 private:
  void run_fine_iterations(const AlignOptions& align_options, bool is_to_report);
  bool report(const AlignOptions& align_options, bool is_narrow);
  bool improve(const Linearization& at, bool hold_joints, double next_sigma);

  double step_tolerance_;  ///< metres
  Objective& objective_;
  Steps& steps_;
  Descended found_;
  Configuration candidate_;
};

}  // namespace lockbox
