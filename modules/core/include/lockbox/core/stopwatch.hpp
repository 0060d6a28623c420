// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// How long something took, milliseconds.
struct Elapsed {
  double wall_ms = 0.0;  ///< by the clock
  double cpu_ms = 0.0;   ///< of the calling thread alone: the same however busy the machine is
};

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
