// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/tracking/tracker.hpp"

namespace lockbox {

/// Runs from its construction on. Asked by the thread that made it.
class Stopwatch {
 public:
  Stopwatch();
  /// The time since its construction.
  Elapsed elapsed() const;

 private:
  Elapsed began_;
};

}  // namespace lockbox
