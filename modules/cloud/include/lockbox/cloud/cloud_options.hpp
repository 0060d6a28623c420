// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// Which measurements of a depth image are used.
struct CloudOptions {
  /// Nearer measurements are dropped. Unit: metres. Source: nearer than what a PrimeSense-class
  /// sensor measures, 0.4 m; a sensor's profile replaces it.
  double min_depth = 0.2;
  /// Farther measurements are dropped. Unit: metres. Source: farther than what a PrimeSense-class
  /// sensor measures, 4.5 m; a sensor's profile replaces it.
  double max_depth = 5.0;
  /// A pixel that differs from both neighbours of a row or column by more than this, times its
  /// depth squared, hangs in the air between two surfaces. 0 keeps all. Unit: 1 / metre. Source:
  /// ten times the noise of a PrimeSense-class sensor.
  double flying_pixel_jump = 0.02;
};

}  // namespace lockbox
