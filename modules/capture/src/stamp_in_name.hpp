// SPDX-License-Identifier: BSD-3-Clause
// Timestamps in the names of files.
#pragma once

#include <optional>
#include <string>

namespace lockbox {

/// Seconds, from a name without extension: PCL's `frame_20121214T142255.814212` (UTC, since 1970),
/// or a name that ends with a number which has a decimal point (seconds) or 10, 13, 16 or 19 digits
/// (seconds, milli-, micro-, nanoseconds since 1970). Other whole numbers, and those with
/// zeros in front, only count frames.
std::optional<double> stamp_in_name(const std::string& stem);

}  // namespace lockbox
