// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/tracking/tracker_options.hpp"

namespace lockbox {

/// The defaults, with searches that end when they are asked to.
inline TrackerOptions stoppable(const StopRequest& stop_request) {
  TrackerOptions options;
  options.stop_request = stop_request;
  return options;
}

}  // namespace lockbox
