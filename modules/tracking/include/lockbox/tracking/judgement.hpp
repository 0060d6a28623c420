// SPDX-License-Identifier: BSD-3-Clause
// Is the estimate believable?
#pragma once

#include <string>

#include "lockbox/registration/articulated_registration.hpp"
#include "lockbox/tracking/tracker_options.hpp"

namespace lockbox {

enum class TrackingStatus { initializing, tracking, uncertain, lost };

/// The word for a states file.
std::string to_string(TrackingStatus status);

/// Of a registered configuration: `tracking`, `uncertain` or `lost`.
TrackingStatus judge(const Agreement& agreement, const TrackerOptions& options);

}  // namespace lockbox
