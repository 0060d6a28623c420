// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox::app {

/// While it lives, the first Ctrl-C (or SIGTERM) is only noted, so that a loop can end after the
/// frame at hand and leave complete files; the second one ends the process as usual.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const;
};

}  // namespace lockbox::app
