// SPDX-License-Identifier: BSD-3-Clause
#include "contrast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockbox {
namespace {

constexpr int kReach = 2;          // pixels: what is around
constexpr double kVariance = 0.3;  // left of the noise's when the mean around is taken away
constexpr double kFallOff = 0.22;  // a deviation of three standard deviations costs two
constexpr double kUneven = -1.0;   // of one pixel

/// Of the known ones, itself included.
float mean_around(const ResidualImage& residuals, int u, int v) {
  float total = 0.0F;
  float count = 0.0F;
  const int bottom = std::min(residuals.height - 1, v + kReach);
  const int right = std::min(residuals.width - 1, u + kReach);
  for (int j = std::max(0, v - kReach); j <= bottom; ++j) {
    for (int i = std::max(0, u - kReach); i <= right; ++i) {
      const float there = residuals.at(i, j);
      if (std::isnan(there)) continue;
      total += there;
      count += 1.0F;
    }
  }
  return total / count;
}

}  // namespace

void ResidualImage::resize(int columns, int rows) {
  width = columns;
  height = rows;
  values.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                std::numeric_limits<float>::quiet_NaN());
}

double evenness(const ResidualImage& residuals) {
  double sum = 0.0;
  for (int v = 0; v < residuals.height; ++v) {
    for (int u = 0; u < residuals.width; ++u) {
      const float here = residuals.at(u, v);
      if (std::isnan(here)) continue;
      const auto contrast = static_cast<double>(here - mean_around(residuals, u, v));
      sum += std::max(1.0 - kFallOff * contrast * contrast / kVariance, kUneven);
    }
  }
  return sum;
}

}  // namespace lockbox
