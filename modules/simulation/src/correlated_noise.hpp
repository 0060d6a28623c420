// SPDX-License-Identifier: BSD-3-Clause
// Gaussian noise over an image whose neighbouring pixels go together.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "random.hpp"

namespace lockbox::simulation {

/// White noise that is filtered by a kernel along rows and columns. The white noise continues
/// beyond the image, so that its border is like its middle.
class CorrelatedNoise {
 public:
  /// kernel: odd number of taps, the sum of whose squares is 1.
  CorrelatedNoise(std::vector<float> kernel, int width, int height, std::uint64_t seed);

  /// Makes the noise of that frame.
  void generate(std::uint64_t frame, const NormalTable& normal, const Executor& executor);

  /// The noise of row v: width values of unit variance.
  void row(int v, std::vector<float>& noise) const;

 private:
  std::vector<float> kernel_;
  std::size_t width_;
  std::size_t rows_;  ///< those of the image and a radius of the kernel above and below
  std::uint64_t seed_;
  std::vector<float> filtered_;  ///< along the rows only: rows x width
};

}  // namespace lockbox::simulation
