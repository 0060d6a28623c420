// SPDX-License-Identifier: BSD-3-Clause
// Tracks the flat front of a block: an image in which every pixel is one metre away.
#include <cstdio>

#include "lockbox/tracking/tracker.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const lockbox::ArticulatedModel model = lockbox::load_model(argv[1]);
  lockbox::Tracker tracker(model, lockbox::TrackerOptions{});

  lockbox::DepthFrame frame;
  frame.camera = {160, 120, 144.0, 144.0, 79.5, 59.5};
  frame.depth.assign(std::size_t{160} * 120, 1000);
  if (tracker.process(frame).status != lockbox::TrackingStatus::initializing) return 1;
  std::printf("%s: %d joint variables\n", model.tree.name.c_str(), model.tree.variables());
  return 0;
}
