// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/judgement.hpp"

namespace lockbox {

std::string to_string(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::initializing:
      return "initializing";
    case TrackingStatus::tracking:
      return "tracking";
    case TrackingStatus::uncertain:
      return "uncertain";
    case TrackingStatus::lost:
      return "lost";
  }
  return "lost";
}

TrackingStatus judge(const Agreement& agreement, const TrackerOptions& options) {
  const double decided = agreement.explained + agreement.contradicted;
  const double share = decided > 0.0 ? agreement.explained / decided : 0.0;
  if (agreement.explained >= options.least_explained && share >= options.least_agreement) {
    return TrackingStatus::tracking;
  }
  const bool lost =
      agreement.explained < 0.5 * options.least_explained || share < options.lost_agreement;
  return lost ? TrackingStatus::lost : TrackingStatus::uncertain;
}

}  // namespace lockbox
