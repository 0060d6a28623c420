// SPDX-License-Identifier: BSD-3-Clause
// How the residuals of pixels that lie close together err, and how to make them err independently.
//
// A structured-light sensor matches windows of its image, so that most of the error of a disparity
// is shared by the pixels around it; rounding and jitter are each pixel's own. Of pixels i, j,
//
//   C_ij = own_i delta_ij + sigma^2 (exp(-|i - j|^2 / (2 L^2)) + 1) = (F F')_ij.
//
// The residuals F^-1 r err independently, by 1: smooth ones are next to nothing then, steps between
// neighbours what they are worth. Tiles a little larger than L keep nearly all of that, each by
// itself. The 1 stands for what a patch's pixels err alike: so do those of the next patches, and
// taken for independent they would make far too much of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lockbox/kernels/padded_rows.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// In inverse depth (1/metre), in which disparities err alike everywhere.
class PatchNoise {
 public:
  /// side: pixels along each side of the patch.
  PatchNoise(const SensorNoise& noise, int side);

  /// Variance of what neighbouring pixels share, and of what a pixel that measures this inverse
  /// depth errs by itself: rounding of disparities and of depths.
  float shared_variance() const { return shared_variance_; }
  float own_variance(float inverse_depth) const;

  /// Leaves no pixels. The next ones have so many values each.
  void clear(std::size_t values);
  /// own: the variance of what it errs by itself. Returns its values, zero at first.
  std::span<float> add(int column, int row, float own);
  /// Pixels of the patch that were added.
  std::size_t count() const { return pixels_.size(); }

  /// Values r, a row a pixel in the order of add(), become F^-1 r.
  void whiten();
  std::span<const float> values(std::size_t pixel) { return values_.row(pixel); }
  /// Returns the sum of the products of each two values over all pixels.
  kernels::PaddedRows& products();

 private:
  struct Pixel {
    std::size_t cell;
    float own;
  };
  std::size_t side_;
  float shared_variance_;
  float own_;
  float rounding_;
  float linear_;
  /// What two pixels share, by how much farther the one is in the patch: rows, then columns, from
  /// 1 - side to side - 1.
  std::vector<float> shared_;
  std::vector<Pixel> pixels_;
  kernels::PaddedRows covariance_;
  kernels::PaddedRows values_;
  kernels::PaddedRows products_;
};

}  // namespace lockbox
