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
// itself. The 1 stands for what a tile's pixels err alike: so do those of the next tiles, and taken
// for independent they would make far too much of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/registration/registration_options.hpp"

namespace lockbox {

/// In inverse depth (1/metre), in which disparities err alike everywhere.
class TileNoise {
 public:
  /// side: pixels along each side of the tile.
  TileNoise(const SensorNoise& noise, int side);

  /// Variance of what neighbouring pixels share, and of what a pixel that measures this inverse
  /// depth errs by itself: rounding of disparities and of depths.
  float shared_variance() const { return shared_[0]; }
  float own_variance(float inverse_depth) const;

  /// Leaves no pixels.
  void clear() { count_ = 0; }
  /// own: the variance of what it errs by itself.
  void add(int column, int row, float own);
  /// Pixels of the tile that were added.
  Eigen::Index count() const { return count_; }

  /// columns <- F^-1 columns, a row a pixel, as they were added.
  void whiten(Eigen::Ref<Eigen::MatrixXf> columns);

 private:
  std::vector<float> shared_;  ///< sigma^2 exp(-d^2 / (2 L^2)), by d along one axis
  std::vector<float> fall_;    ///< exp(-d^2 / (2 L^2))
  float own_;
  float rounding_;
  Eigen::Index count_ = 0;
  std::vector<Pixel> pixels_;  ///< in the tile; the first `count_`
  Eigen::MatrixXf factor_;     ///< C, then F; its first rows and columns
};

}  // namespace lockbox
