// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/reported.hpp"

#include <cmath>
#include <limits>

namespace lockbox {

std::string to_string(Alternative::Kind kind) {
  return kind == Alternative::Kind::flip ? "flip" : "elsewhere";
}

bool is_known(const TrackingResult& result) {
  return result.status == TrackingStatus::tracking || result.status == TrackingStatus::uncertain;
}

double joint_sigma(const Joint& joint, const TrackingResult& result) {
  if (!is_known(result)) return std::numeric_limits<double>::quiet_NaN();
  const auto unknown = static_cast<std::size_t>(unknown_of(joint.variable));
  if (!result.observable[unknown]) return std::numeric_limits<double>::infinity();
  return std::abs(joint.multiplier) * result.sigma(unknown_of(joint.variable));
}

}  // namespace lockbox
