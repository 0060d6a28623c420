// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// What speaks for a configuration and against it.
struct ViewEvidence {
  /// What one pixel counts that is not explained, where one explained perfectly counts 1: with
  /// something in front of the model, and one through which the camera saw. Source: not recorded.
  /// Doubled, configurations are refused that explain twice as much beside as many such pixels.
  static constexpr double kOccludedPixel = -0.15;
  static constexpr double kViolatingPixel = -6.0;

  double measured = 0.0;      ///< pixels of the view that show the model and have a depth
  double explained = 0.0;     ///< of them, weighted by how well
  double contradicted = 0.0;  ///< pixels that the camera saw through
  double occluded = 0.0;      ///< pixels with something in front
  double continues = 0.0;     ///< share of the contour beyond which the surface goes on
  double in_view = 0.0;       ///< share of the surface that faces the camera: within the image

  /// The larger, the better, among configurations near each other.
  double fit() const;

  /// The larger, the better, among guesses that are still to be refined; tolerance: 1 before
  /// anything is refined, 0 when all is.
  double total(double tolerance) const;
};

}  // namespace lockbox
