// SPDX-License-Identifier: BSD-3-Clause
// Where the object will be in the next frame, and how wrong that may be.
#pragma once

#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/configuration.hpp"

namespace lockbox {

/// Constant velocity of every unknown that was observed twice in a row; an unobserved one stands
/// still at once, or a joint would drift into its limit, and a base along a wall. The gate adapts
/// to the prediction's own recent errors (after Vizzo et al., KISS-ICP, 2023).
class MotionPredictor {
 public:
  explicit MotionPredictor(const KinematicTree& tree);

  /// Forgets all motion: at rest at this configuration.
  void reset(double stamp, const Configuration& configuration);

  Configuration predict(double stamp) const;

  /// surface_error: how far surfaces were from where predict() had put them, metres.
  /// observable: by unknown, as in RegistrationResult.
  void update(double stamp, const Configuration& configuration, const std::vector<bool>& observable,
              double surface_error);

  /// How far surfaces may be from where predict() puts them, metres.
  double annealing_sigma() const { return annealing_sigma_; }

 private:
  const KinematicTree& tree_;
  double stamp_ = 0.0;
  Configuration last_;
  std::vector<bool> last_observable_;    ///< by unknown
  Twist base_velocity_ = Twist::Zero();  ///< base frame, per second
  Eigen::VectorXd joint_velocity_;
  double annealing_sigma_ = 0.0;
};

}  // namespace lockbox
