// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/tile_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockbox {
namespace {

constexpr double kLeastLength = 0.1;  // pixels: as good as none

double square(double x) {
  return x * x;
}

}  // namespace

TileNoise::TileNoise(const SensorNoise& noise, int side)
    : own_(static_cast<float>(noise.own_share * noise.depth_quadratic)),
      rounding_(static_cast<float>(noise.depth_floor)),
      pixels_(static_cast<std::size_t>(side * side)),
      factor_(side * side, side * side) {
  const double length = std::max(noise.correlation_pixels, kLeastLength);
  const double variance = square(noise.depth_quadratic) * (1.0 - square(noise.own_share));
  for (int d = 0; d < side; ++d) {
    const double fall = std::exp(-0.5 * square(d / length));
    fall_.push_back(static_cast<float>(fall));
    shared_.push_back(static_cast<float>(variance * fall));
  }
}

float TileNoise::own_variance(float inverse_depth) const {
  const float rounding = rounding_ * inverse_depth * inverse_depth;
  return own_ * own_ + rounding * rounding;
}

void TileNoise::add(int column, int row, float own) {
  for (Eigen::Index j = 0; j < count_; ++j) {
    const Pixel& other = pixels_[static_cast<std::size_t>(j)];
    factor_(count_, j) = shared_[static_cast<std::size_t>(std::abs(column - other.u))] *
                             fall_[static_cast<std::size_t>(std::abs(row - other.v))] +
                         shared_[0];
  }
  factor_(count_, count_) = own + 2.0F * shared_[0];
  pixels_[static_cast<std::size_t>(count_++)] = {column, row};
}

// A Ref is a reference itself. NOLINTNEXTLINE(performance-unnecessary-value-param)
void TileNoise::whiten(Eigen::Ref<Eigen::MatrixXf> columns) {
  Eigen::Ref<Eigen::MatrixXf> pixels(factor_.topLeftCorner(count_, count_));
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXf>> factors(pixels);
  factors.matrixL().solveInPlace(columns);
}

}  // namespace lockbox
