// SPDX-License-Identifier: BSD-3-Clause
// Modes of live cameras as people write them: `640x480@30`, `320x240@60,100um`.
#pragma once

#include <string>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Reads WIDTHxHEIGHT@RATE, with `,1mm` or `,100um` behind it where the unit matters. Throws
/// InputError that says how modes are written.
WantedMode parse_depth_mode(const std::string& text);

/// Writes the mode as parse_depth_mode() reads it.
std::string to_string(const DepthMode& mode);
std::string to_string(const WantedMode& mode);

}  // namespace lockbox
