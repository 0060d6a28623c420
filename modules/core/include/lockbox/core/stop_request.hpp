// SPDX-License-Identifier: BSD-3-Clause
// How what takes seconds is asked to stop, by whoever has started it.
#pragma once

#include <functional>

#include "lockbox/core/parallel.hpp"

namespace lockbox {

/// Whether work under way is to stop. It is asked a thousand times a second, by several threads at
/// once. Empty: never.
using StopRequest = std::function<bool()>;

/// Throws Stopped if it is.
inline void stop_if(const StopRequest& requested) {
  if (requested && requested()) throw Stopped();
}

}  // namespace lockbox
