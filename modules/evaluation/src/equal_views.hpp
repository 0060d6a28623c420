// SPDX-License-Identifier: BSD-3-Clause
// Configurations that no sensor can tell from the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/evaluation/answer_errors.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/simulation/placed_scene.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// Of one view of the exact model: what is followed or sought is so in an image of that, and
/// compared in views without noise. A configuration looks the same as the truth if the two differ
/// by no more than errors of 1.5 times the bound (bound.hpp) in each unknown do; pixels that see
/// different surfaces count as three standard deviations each.
class EqualViews {
 public:
  /// The model and the comparison must outlive it. seed: of the sensor's noise.
  EqualViews(const ArticulatedModel& model, const AnswerComparison& comparison,
             const PinholeCamera& camera, const SensorModel& sensor, const PlacedScene& scene,
             const State& truth, const Eigen::VectorXd& bound, std::uint64_t seed,
             const Executor& executor);

  /// Whether the answer, followed, stays wrong and looks the same.
  bool holds(const TrackingResult& answer);

  /// Whether the object turned as its base may be turned without looking different, its joints then
  /// sought over their whole ranges, is something else that looks the same: a board whose sliders
  /// stand at the other ends of their rails.
  bool any();

 private:
  bool is_other(const Configuration& configuration) const;
  bool looks_like_truth(const Configuration& configuration) const;

  const ArticulatedModel& model_;
  const AnswerComparison& comparison_;
  PinholeCamera camera_;
  SensorModel sensor_;
  PlacedScene scene_;
  State truth_;
  Eigen::VectorXd bound_;
  Executor executor_;
  TrackerOptions options_;
  TiledCloud cloud_;
  ArticulatedRegistration registration_;
};

}  // namespace lockbox
