// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox::app {

/// A PrimeSense-class sensor at full resolution.
inline constexpr PinholeCamera kPrimeSenseCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

}  // namespace lockbox::app
