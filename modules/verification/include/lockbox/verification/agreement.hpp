// SPDX-License-Identifier: BSD-3-Clause
// How a registered model compares with the image.
#pragma once

namespace lockbox {

/// Shares of the visible surface within the image, of the model or of one body; all zero without
/// an image.
struct Agreement {
  double explained = 0.0;     ///< measured where the model says
  double contradicted = 0.0;  ///< seen through, or measured behind as a group or as a whole
  double occluded = 0.0;      ///< something else in front
  double unknown = 0.0;       ///< not measured, or beside a contour that jitter may have moved
  /// The part of what is explained that is measured behind the surface by more than a standard
  /// deviation, less what is so far before it. Noise goes both ways alike.
  double recedes = 0.0;
  /// The part of what is contradicted whose groups were measured behind the surface as wholes. It
  /// lies elsewhere there, though the rest of the body, if that is flat or round, may be explained.
  double groups_behind = 0.0;
  double pixels = 0.0;  ///< of the camera, of which these are shares

  /// Returns the share that speaks for the model, of what speaks for it or against it; 0 if nothing
  /// does.
  double precision() const {
    return explained > 0.0 ? explained / (explained + contradicted) : 0.0;
  }

  /// Returns a number that compares configurations: a contradiction counts more than what remains
  /// unexplained, which may be hidden.
  double score() const { return explained - 2.0 * contradicted; }
};

/// What the camera sees just beyond the model's contour, where something farther away, or nothing,
/// should be. Where the surface goes on, the model may be a piece of a wall.
struct ContourAgreement {
  int samples = 0;  ///< at the contour, where something in front does not hide what is beyond
  int goes_on = 0;  ///< of these, where the scene continues the model's surface

  /// Returns the share of the contour at which the model's surface goes on; 0 without a contour.
  double continued() const { return samples > 0 ? static_cast<double>(goes_on) / samples : 0.0; }
};

}  // namespace lockbox
