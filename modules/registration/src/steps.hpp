// SPDX-License-Identifier: BSD-3-Clause
// Steps that stay within the limits of the joints, and how far they move surfaces.
#pragma once

#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/registration/registration_options.hpp"
#include "lockbox/solver/bounded_step.hpp"
#include "lockbox/solver/motion_metric.hpp"

namespace lockbox {

class Steps {
 public:
  /// The tree must outlive it.
  Steps(const KinematicTree& tree, const RegistrationOptions& options);

  /// The best step from a configuration, to which the equations belong. Valid until the next call.
  const Eigen::VectorXd& best(const NormalEquations& equations, const Configuration& from,
                              bool hold_joints, double damping = 0.0);

  /// Adds the best step to a configuration that is `from`; false, and nothing is changed, if it
  /// moves surfaces farther than this, metres.
  bool add_short(const NormalEquations& equations, bool hold_joints, double farthest,
                 Configuration& from);

  /// Metres: what a refinement moves farther than the image was looked at is not to be trusted.
  double farthest_refinement(const PinholeCamera& camera, const Configuration& from) const;

  const MotionMetric& moves() const { return moves_; }
  const StepScale& scale() const { return scale_; }
  /// Returns by unknown whether it stays where it is in all alignments.
  const std::vector<bool>& held() const { return held_; }

 private:
  void set_limits(const Configuration& from, bool hold_joints);

  const KinematicTree& tree_;
  double gate_;
  SensorNoise noise_;
  MotionMetric moves_;
  StepScale scale_;
  std::vector<bool> held_;
  StepLimits limits_;
  BoundedStepSolver solver_;
};

}  // namespace lockbox
