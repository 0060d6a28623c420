// SPDX-License-Identifier: BSD-3-Clause
// How what takes seconds is asked to stop, by whoever has started it.
#pragma once

#include <exception>
#include <functional>

namespace lockbox {

/// Whether work under way is to stop. It is asked a thousand times a second, by several threads at
/// once. Empty: never.
using StopRequest = std::function<bool()>;

/// What work throws that was stopped.
class Stopped : public std::exception {
 public:
  /// Returns a word for logs.
  const char* what() const noexcept override { return "stopped"; }
};

/// Throws Stopped if it is.
inline void stop_if(const StopRequest& requested) {
  if (requested && requested()) throw Stopped();
}

}  // namespace lockbox
