// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "lockbox/tracking/answer.hpp"
#include "lockbox/tracking/classification.hpp"

namespace lockbox {

/// What was concluded of an answer, as the next frame needs it.
struct Verdict {
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

inline Verdict verdict_on(const Answer& answer, const TrackerOptions& options) {
  Verdict verdict{.status = classify(answer, options),
                  .rival_distance = answer.rival_distance,
                  .base_turning_sigma = answer.base_turning_sigma,
                  .belief = answer.belief,
                  .doubted = {}};
  if (verdict.status == TrackingStatus::tracking) {
    verdict.doubted = contradicted_bodies(answer, options);
  }
  return verdict;
}

}  // namespace lockbox
