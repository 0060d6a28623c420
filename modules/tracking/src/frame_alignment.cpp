// SPDX-License-Identifier: BSD-3-Clause
#include "frame_alignment.hpp"

#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/tracking/acquisition.hpp"
#include "lockbox/tracking/classification.hpp"

namespace lockbox {

FrameAlignment::FrameAlignment(ArticulatedRegistration& registration, const TiledCloud& cloud,
                               const TrackerOptions& options, double annealing_sigma)
    : registration_(registration),
      cloud_(cloud),
      options_(options),
      annealing_sigma_(annealing_sigma) {}

Answer FrameAlignment::once(const Configuration& prediction, bool is_predicted) {
  return registration_.align(cloud_, prediction,
                             {.annealing_sigma = annealing_sigma_,
                              .iterations = options_.registration.max_iterations,
                              .is_predicted = is_predicted});
}

Answer FrameAlignment::until_rest(const Configuration& start, const Answer& aligned) {
  Answer result = aligned;
  Configuration from = start;
  for (int round = 0; round < options_.most_rounds && is_on_its_way(from, result); ++round) {
    from = result.at_rest;
    result = registration_.align(cloud_, from, further());
  }
  return result;
}

Answer FrameAlignment::followed(const Configuration& start) {
  return until_rest(start, registration_.align(cloud_, start, further()));
}

void FrameAlignment::carry_parts(const Configuration& prediction, Answer& best) {
  const Configuration carried{best.at_rest.T_camera_base, prediction.q};
  const double gate = options_.registration.gate * annealing_sigma_;
  if (registration_.moves().between(prediction, carried) <= gate) return;
  const Answer at_rest = until_rest(carried, once(carried, false));
  if (classify(at_rest, options_) == TrackingStatus::tracking) {
    best = at_rest;
  } else {
    keep_better(at_rest, options_, best);
  }
}

/// Returns how to go on from where the last alignment of the frame has ended.
AlignOptions FrameAlignment::further() const {
  return {.annealing_sigma = annealing_sigma_,
          .iterations = options_.further_iterations,
          .goes_on = true};
}

/// What has come farther than the gate is wide was pulled along by what little was within it, and
/// may be uncertain enough for steps of millimetres to be no more than noise.
bool FrameAlignment::is_on_its_way(const Configuration& start, const Answer& result) const {
  return result.last_move > options_.resting_move ||
         registration_.moves().between(start, result.at_rest) >
             options_.registration.gate * annealing_sigma_;
}

}  // namespace lockbox
