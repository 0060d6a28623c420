// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// Metres: more than distances in single precision err.
inline constexpr float kDistanceRounding = 1e-5F;

}  // namespace lockbox
