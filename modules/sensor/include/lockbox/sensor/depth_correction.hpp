// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// What a sensor measures is z; what is there is
///
///   (offset + scale z + quadratic z^2) (1 + radial r^2),
///
/// r being the tangent of the angle between the pixel's ray and the optical axis.
struct DepthCorrection {
  double scale = 1.0;      ///< metres a metre
  double offset = 0.0;     ///< metres
  double quadratic = 0.0;  ///< 1/metre
  double radial = 0.0;     ///< 1, see above

  /// Returns the depth that is there, metres, for a depth z measured on the optical axis.
  double on_axis(double z) const { return offset + (scale + quadratic * z) * z; }

  bool operator==(const DepthCorrection&) const = default;
};

}  // namespace lockbox
