// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/publishing/publisher.hpp"
#include "run_settings.hpp"

namespace lockbox::app {

/// What a run does when the lines of `--publish stdout` cannot be written any more.
class PublishedOutput {
 public:
  /// Both are referred to.
  PublishedOutput(const Publisher& publisher, const RunSettings& settings)
      : publisher_(publisher), settings_(settings) {}

  /// Whether its reader has gone away and the run has no other output, so that it has to end. If it
  /// has others, the first call says that they go on. Throws InputError if standard output cannot
  /// be written for another reason, such as a full disk.
  bool is_in_vain();

 private:
  const Publisher& publisher_;
  const RunSettings& settings_;
  bool is_said_ = false;
};

}  // namespace lockbox::app
