// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// Of a quaternion's norm, for files written with few digits.
inline constexpr double kQuaternionTolerance = 1e-2;

}  // namespace lockbox
