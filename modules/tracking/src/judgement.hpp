// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lockbox/tracking/answer.hpp"
#include "lockbox/tracking/classification.hpp"

namespace lockbox {

/// What was concluded of an answer, as the next frame needs it.
struct Judgement {
  TrackingStatus status = TrackingStatus::initializing;  ///< by all but the apparent size
  double rival_distance = 0.0;                           ///< see Answer: until a search tells
  double base_turning_sigma = 0.0;                       ///< see RegistrationResult
  double belief = 0.0;                                   ///< see Answer
  std::vector<int> doubted;  ///< bodies that contradict the image, in order, if `tracking`

  /// Whether there is an estimate to follow.
  bool is_known() const {
    return status == TrackingStatus::tracking || status == TrackingStatus::uncertain;
  }
};

inline Judgement judgement_of(const Answer& answer, const TrackerOptions& options) {
  Judgement judgement{.status = classify(answer, options),
                      .rival_distance = answer.rival_distance,
                      .base_turning_sigma = answer.base_turning_sigma,
                      .belief = answer.belief,
                      .doubted = {}};
  if (judgement.status == TrackingStatus::tracking) {
    judgement.doubted = contradicted_bodies(answer, options);
  }
  return judgement;
}

}  // namespace lockbox
