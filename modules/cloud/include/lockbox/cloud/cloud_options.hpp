// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// Which measurements of a depth image are used.
struct CloudOptions {
  double min_depth = 0.2;  ///< metres; nearer measurements are dropped
  double max_depth = 5.0;  ///< metres; farther measurements are dropped
  /// A pixel that differs from both neighbours of a row or column by more than this, times its
  /// depth squared, hangs in the air between two surfaces (1 / metre). 0 keeps all.
  double flying_pixel_jump = 0.02;
};

}  // namespace lockbox
