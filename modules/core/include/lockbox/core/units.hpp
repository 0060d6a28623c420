// SPDX-License-Identifier: BSD-3-Clause
// The project computes in metres and radians. People read and write millimetres and degrees.
#pragma once

#include <numbers>

namespace lockbox {

inline constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< times radians
inline constexpr double kRadians = std::numbers::pi / 180.0;  ///< times degrees
inline constexpr double kMillimetres = 1000.0;                ///< times metres
inline constexpr double kFullTurn = 2.0 * std::numbers::pi;   ///< radians

}  // namespace lockbox
