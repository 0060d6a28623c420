// SPDX-License-Identifier: BSD-3-Clause
// Single frames, aligned to convergence, against what the sensor's noise allows.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// One unknown of one frame. Metres or radians.
struct UnknownError {
  double error = 0.0;
  double sigma = 0.0;  ///< as reported
  bool observable = false;
  double bound = 0.0;  ///< of the truth, see bound_sigma
};

/// Frames are those of simulate_random_frame. Every one starts anew, up to 5 mm and a degree wrong
/// in every unknown, without anything known from before.
class AccuracyExperiment {
 public:
  AccuracyExperiment(const ArticulatedModel& model, const PinholeCamera& camera,
                     const SensorModel& sensor, std::uint64_t seed,
                     const RegistrationOptions& options, const Executor& executor);

  /// Returns the errors by unknown: base twist (v, w) in the base's frame, then the variables.
  std::vector<UnknownError> align_frame(std::uint64_t number);

 private:
  Configuration wrong_start(const Configuration& truth, std::uint64_t number) const;

  const ArticulatedModel& model_;
  PinholeCamera camera_;
  SensorModel sensor_;
  std::uint64_t seed_;
  Executor executor_;
  ArticulatedRegistration registration_;
};

/// What a frame's bound allows the root mean square of an unknown's errors: 1.5 times the bound,
/// and a floor for what rounding of depths leaves, in quadrature.
double allowed_error(const KinematicTree& tree, int unknown, double bound);

/// Whether a frame tells of an unknown at all: its bound is below 5 mm or 2 degrees.
bool is_told(const KinematicTree& tree, int unknown, double bound);

}  // namespace lockbox
