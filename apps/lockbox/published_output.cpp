// SPDX-License-Identifier: BSD-3-Clause
#include "published_output.hpp"

#include <cerrno>
#include <cstring>
#include <iostream>
#include <string>

#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

bool has_other_outputs(const RunSettings& settings) {
  return !settings.output.empty() || !settings.recording.empty() || !settings.snapshots.empty() ||
         settings.view || settings.publish.size() > 1;
}

}  // namespace

bool PublishedOutput::is_in_vain() {
  const int error = publisher_.output_error();
  if (error == 0) return false;
  if (error != EPIPE) {
    throw InputError("standard output", std::string("cannot be written (") + std::strerror(error) +
                                            "); is the disk full?");
  }
  if (!has_other_outputs(settings_)) return true;
  if (!is_said_) {
    std::cerr << "lockbox: nobody reads standard output any more; the other outputs go on\n";
  }
  is_said_ = true;
  return false;
}

}  // namespace lockbox::app
