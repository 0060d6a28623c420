// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

// Radians: no depth camera sees less, or more.
inline constexpr double kMinimumFieldOfView = 0.1;
inline constexpr double kMaximumFieldOfView = 3.0;

}  // namespace lockbox
