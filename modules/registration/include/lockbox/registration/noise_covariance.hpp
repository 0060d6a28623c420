// SPDX-License-Identifier: BSD-3-Clause
// The covariance of the residuals of neighbouring pixels, and its inverse.
//
// A structured-light sensor matches windows of its image, so that most of the error of a disparity
// is shared by the pixels around it; rounding and jitter are each pixel's own:
//
//   C = W^-1 + sigma^2 R,    R_ij = exp(-|i - j|^2 / (2 L^2)), cut off at 3 L along each axis.
//
// With x = C^-1 r, r' x is what a residual image r costs: smooth parts of it next to nothing, steps
// between neighbours what they are worth.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lockbox/kernels/separable_filter.hpp"

namespace lockbox {

/// Reuses its buffers.
class NoiseCovariance {
 public:
  /// sigma, length: of the shared error, in the unit of the residuals and in pixels.
  NoiseCovariance(double sigma, double length);

  /// weights: 1 / variance of each pixel's own error, row by row; 0: the pixel is left out.
  void set_weights(int width, int height, std::span<const float> weights);

  /// C^-1 residuals by conjugate gradients, up to 1 %; 0 for pixels left out. For
  /// residuals much like the last ones they begin with that solution. The result is valid until
  /// the next call.
  std::span<const float> solve(std::span<const float> residuals);

  /// residuals' C^-1 residuals, after solve() for them. What the solution is off enters squared.
  double chi_squared() const { return static_cast<double>((estimate_ * (right_ + left_)).sum()); }

 private:
  void multiply(const Eigen::ArrayXf& image, Eigen::ArrayXf& product);
  void begin();

  std::vector<float> taps_;  ///< of sigma^2 R along one axis each, from the centre on
  kernels::PaddedLayout layout_{};
  std::vector<float> padded_;
  std::vector<float> along_rows_;
  std::vector<float> shared_;

  // By pixel.
  Eigen::ArrayXf roots_;     ///< of the weights
  Eigen::ArrayXf right_;     ///< W^1/2 residuals
  Eigen::ArrayXf estimate_;  ///< W^-1/2 C^-1 residuals
  Eigen::ArrayXf left_;      ///< of the right side, by the estimate
  Eigen::ArrayXf direction_;
  Eigen::ArrayXf product_;
  Eigen::ArrayXf solution_;
};

}  // namespace lockbox
