// SPDX-License-Identifier: BSD-3-Clause
// How a depth sensor errs, as far as an estimate from its images has to know.
#pragma once

namespace lockbox {

/// Standard deviations of a pixel, see kernels::PointNoise. Source: share/sensors/primesense.yaml,
/// a PrimeSense-class sensor (75 mm baseline, 1/8 pixel disparity steps).
struct SensorNoise {
  /// The standard deviation along the ray, at any depth. Unit: metres.
  double depth_floor = 0.0003;
  /// What it grows by with the depth. Unit: metres a metre.
  double depth_linear = 0.0;
  /// What it grows by with the square of the depth. Unit: 1 / metre.
  double depth_quadratic = 0.0021;
  /// The standard deviation across the ray. Unit: pixels.
  double lateral_pixels = 0.5;
  /// Of the standard deviation along the ray, what each pixel errs by itself. The rest it shares
  /// with its neighbours, correlated by exp(-r^2 / (2 correlation_pixels^2)).
  double own_share = 0.45;
  /// How far these errors are alike. Unit: pixels.
  double correlation_pixels = 3.0;

  /// Returns the standard deviation along the ray at depth z, metres.
  double sigma_z(double z) const {
    return depth_floor + depth_linear * z + depth_quadratic * z * z;
  }
  /// Across the ray at depth z, with focal length fx in pixels: metres.
  double sigma_lateral(double z, double fx) const { return lateral_pixels / fx * z; }
  /// Returns the standard deviation of 1/depth, at that inverse depth: 1/metre.
  double sigma_inverse(double inverse_depth) const {
    return depth_quadratic + inverse_depth * (depth_linear + inverse_depth * depth_floor);
  }
  /// Returns the standard deviation of 1/depth, 1/metre. It is nearly the same at all depths, and
  /// taken where objects usually are.
  double sigma_inverse_depth() const {
    constexpr double kUsualDepth = 1.732;  // metres
    return sigma_z(kUsualDepth) / (kUsualDepth * kUsualDepth);
  }

  /// Returns the sum of the errors' autocorrelation over all offsets, in pixels: the mean over many
  /// neighbours has the variance of so many times fewer independent pixels. 1 where each errs by
  /// itself.
  double correlation_area() const;

  bool operator==(const SensorNoise&) const = default;
};

}  // namespace lockbox
