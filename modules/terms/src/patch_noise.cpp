// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/patch_noise.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/square.hpp"
#include "lockbox/kernels/whitening.hpp"

namespace lockbox {
namespace {

constexpr double kLeastLength = 0.1;  // pixels: as good as none
/// Values of a cell that memory is kept for; more allocate. Source: not recorded. Doubled, each
/// patch keeps twice the memory.
constexpr std::size_t kUsualValues = 32;

}  // namespace

PatchNoise::PatchNoise(const SensorNoise& noise, int side)
    : side_(static_cast<std::size_t>(side)),
      own_(static_cast<float>(noise.own_share * noise.depth_quadratic)),
      rounding_(static_cast<float>(noise.depth_floor)),
      linear_(static_cast<float>(noise.depth_linear)) {
  // Nothing is allocated while patches are compared, unless they have many values.
  const std::size_t cells = side_ * side_;
  pixels_.reserve(cells);
  covariance_.resize(cells, cells);
  values_.resize(cells, kUsualValues);
  const double length = std::max(noise.correlation_pixels, kLeastLength);
  const double variance = square(noise.depth_quadratic) * (1.0 - square(noise.own_share));
  shared_variance_ = static_cast<float>(variance);
  for (int dv = 1 - side; dv < side; ++dv) {
    for (int du = 1 - side; du < side; ++du) {
      const double fall = std::exp(-0.5 * (square(du / length) + square(dv / length)));
      shared_.push_back(static_cast<float>(variance * (fall + 1.0)));
    }
  }
}

float PatchNoise::own_variance(float inverse_depth) const {
  const float rounding = (rounding_ * inverse_depth + linear_) * inverse_depth;
  return own_ * own_ + rounding * rounding;
}

void PatchNoise::clear(std::size_t values) {
  pixels_.clear();
  values_.resize(side_ * side_, values);
}

std::span<float> PatchNoise::add(int column, int row, float own) {
  const std::size_t cells_of_row = 2 * side_ - 1;  // as in shared_
  pixels_.push_back(
      {static_cast<std::size_t>(row) * cells_of_row + static_cast<std::size_t>(column), own});
  return values_.row(pixels_.size() - 1);
}

void PatchNoise::whiten() {
  covariance_.resize(count(), count());
  const std::size_t here = shared_.size() / 2;
  for (std::size_t i = 0; i < count(); ++i) {
    const std::span<float> row = covariance_.row(i);
    for (std::size_t j = i; j < count(); ++j) {
      row[j] = shared_[here + pixels_[j].cell - pixels_[i].cell];
    }
    row[i] += pixels_[i].own;
  }
  kernels::whiten(covariance_, values_);
}

kernels::PaddedRows& PatchNoise::products() {
  kernels::multiply_columns(count(), values_, products_);
  return products_;
}

}  // namespace lockbox
