// SPDX-License-Identifier: BSD-3-Clause
// The search of the whole image, in one depth image.
#include "drawer.hpp"
#include "lockbox/initialization/initializer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const Executor executor(1);
  static Initializer initializer(drawer(), {}, executor);
  TiledCloud cloud;
  cloud.assign(frames_from(data, size, 1).front(), {}, executor);
  for (const Candidate& candidate : initializer.glance(cloud)) {
    require_sound(candidate.configuration);
    require(candidate.belief >= 0.0 && candidate.belief <= 1.0, "belief is a probability");
  }
  return 0;
}
