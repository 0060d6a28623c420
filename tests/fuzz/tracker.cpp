// SPDX-License-Identifier: BSD-3-Clause
// The tracker from a given start, without searches, on up to three depth images.
#include "lockbox/tracking/tracker.hpp"

#include "drawer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  TrackerOptions options;
  options.threads = 1;
  options.search_anywhere = false;
  Tracker tracker(drawer(), options);
  tracker.start(drawer_start());
  for (const DepthFrame& frame : frames_from(data, size, 3)) {
    const TrackingResult& result = tracker.process(frame);
    require(result.belief >= 0.0 && result.belief <= 1.0, "belief is a probability");
    if (result.status == TrackingStatus::initializing) continue;
    require_sound(result.configuration);
    require((result.sigma.array() >= 0.0).all(), "deviations are not negative");
  }
  return 0;
}
