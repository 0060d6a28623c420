// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lockbox {

/// What is known of the object in a frame.
enum class TrackingStatus { initializing, tracking, uncertain, lost };

/// The word for a states file.
std::string to_string(TrackingStatus status);

}  // namespace lockbox
