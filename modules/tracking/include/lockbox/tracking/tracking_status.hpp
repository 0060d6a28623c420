// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lockbox {

/// What is known of the object in a frame.
enum class TrackingStatus { initializing, tracking, uncertain, lost };

/// Returns the word for it in a states file.
std::string to_string(TrackingStatus status);

}  // namespace lockbox
