// SPDX-License-Identifier: BSD-3-Clause
// What the projector of a structured-light sensor cannot light up, because something nearer stands
// in between: the camera sees it, but measures nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox::simulation {

/// Buffers are reused.
class ProjectorShadow {
 public:
  /// The projector stands at x = baseline (metres, positive) of the camera's frame and looks the
  /// same way. Only what the camera sees casts shadows. Cost: one pass over the samples.
  //
  // In the projector's image the sample (u, v) with the disparity d = fx baseline / z lies at
  // column u - d of the same row. Of all that lies at one column the largest disparity is lit.
  void cast(const RenderedDepth& image, const PinholeCamera& camera, double baseline,
            const Executor& executor);

  /// Whether that sample, in row-major order, lies in the shadow.
  bool covers(std::size_t sample) const { return covered_[sample] != 0; }

 private:
  std::vector<std::uint8_t> covered_;
};

}  // namespace lockbox::simulation
