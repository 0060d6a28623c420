// SPDX-License-Identifier: BSD-3-Clause
// What a sensor makes of surfaces: it compares windows of pixels, so that it sees no gap that is
// narrower than one, and rounds off what bends within one.
#pragma once

#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"

namespace lockbox {

/// Reuses its buffers.
class SensorWindow {
 public:
  /// Smears an image's cells, row by row: inverse depths, 1/metre, 0 in blank ones. Contours stay
  /// where they are. The result is valid until the next call.
  std::span<const float> smear(std::span<const float> cells, int width, const Executor& executor);

 private:
  std::vector<float> cells_;
  std::vector<float> passed_;
};

}  // namespace lockbox
