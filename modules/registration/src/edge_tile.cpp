// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/edge_tile.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

using Taps = std::array<float, kernels::kWindowTaps>;

constexpr std::size_t kRows = kernels::kWindowRows;

/// Gaussian density around a pixel's centre, at points `shift` of their distance after the samples.
Taps jitter_density(double lateral_pixels, double shift) {
  const double sigma = EdgeTile::kSamples * std::max(lateral_pixels, 1e-3);
  std::array<double, kernels::kWindowTaps> weights{};
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double offset = (static_cast<double>(i) - EdgeTile::kReach + shift) / sigma;
    weights[i] = std::exp(-0.5 * offset * offset);
    sum += weights[i];
  }
  Taps taps{};
  std::transform(weights.begin(), weights.end(), taps.begin(),
                 [sum](double weight) { return static_cast<float>(weight / sum); });
  return taps;
}

/// Over the samples around the pixel of a column.
float blur(const kernels::ColumnMoments::Sums& columns, const Taps& taps, std::size_t pixel) {
  using Weights = Eigen::Matrix<float, static_cast<int>(kernels::kWindowTaps), 1>;
  const float* const around = &columns[kernels::kSamplesPerPixel * pixel];
  return Eigen::Map<const Weights>(taps.data()).dot(Eigen::Map<const Weights>(around));
}

}  // namespace

EdgeTile::EdgeTile(double lateral_pixels)
    : taps_{jitter_density(lateral_pixels, 0.0), jitter_density(lateral_pixels, 0.5)} {}

bool EdgeTile::read(const RenderedDepth& samples, int left, int top) {
  const auto first_column = static_cast<std::size_t>(left);
  const auto first_row = static_cast<std::size_t>(top);
  const auto width = static_cast<std::size_t>(samples.width);
  for (std::size_t j = 0; j < kRows; ++j) {
    const float* const depths = &samples.depth[(first_row + j) * width + first_column];
    float* const d = &window_.d[j * kernels::kWindowStride];
    for (std::size_t i = 0; i < kRows; ++i) d[i] = 1.0F / depths[i];  // 1 / infinity = 0
  }
  reference_ = window_.d[kernels::kWindowStride * (kRows / 2) + kRows / 2];
  return find_bodies(samples, first_column, first_row);
}

bool EdgeTile::find_bodies(const RenderedDepth& samples, std::size_t left, std::size_t top) {
  body_count_ = 0;
  shows_nothing_ = false;
  const std::int16_t* above = nullptr;
  for (std::size_t j = 0; j < kRows; ++j) {
    const std::int16_t* const ids =
        &samples.id[(top + j) * static_cast<std::size_t>(samples.width) + left];
    float* const bodies = &window_.body[j * kernels::kWindowStride];
    for (std::size_t i = 0; i < kRows; ++i) bodies[i] = static_cast<float>(ids[i]);
    const bool is_as_above = above != nullptr && std::equal(ids, ids + kRows, above);
    above = ids;
    for (std::size_t i = 0; i < kRows && !is_as_above; ++i) {
      if ((i == 0 || ids[i] != ids[i - 1]) && !add_body(ids[i])) return false;
    }
  }
  return body_count_ > 0;
}

/// False if there are too many.
bool EdgeTile::add_body(std::int16_t body) {
  if (body == kNothing) {
    shows_nothing_ = true;
    return true;
  }
  const auto end = bodies_.begin() + static_cast<std::ptrdiff_t>(body_count_);
  if (std::find(bodies_.begin(), end, body) != end) return true;
  if (end == bodies_.end()) return false;
  bodies_[body_count_++] = body;
  return true;
}

/// Inverse depth is linear in the image of a plane.
bool EdgeTile::bends(int column, int row, float least) const {
  constexpr std::size_t kInRow = kernels::kSamplesPerPixel;
  constexpr std::size_t kInColumn = kernels::kSamplesPerPixel * kernels::kWindowStride;
  const float* const d =
      &window_.d[static_cast<std::size_t>(kReach + kSamples * row) * kernels::kWindowStride +
                 static_cast<std::size_t>(kReach + kSamples * column)];
  const float left = *(d - kInRow);
  const float right = *(d + kInRow);
  const float above = *(d - kInColumn);
  const float below = *(d + kInColumn);
  if (std::min({*d, left, right, above, below}) == 0.0F) return false;
  return std::abs(left + right - 2.0F * *d) > least || std::abs(above + below - 2.0F * *d) > least;
}

bool EdgeTile::may_show_nothing(int column, int row) const {
  if (!shows_nothing_) return false;
  const auto first_column = static_cast<std::size_t>(kSamples * column);
  const auto first_row = static_cast<std::size_t>(kSamples * row);
  for (std::size_t j = 0; j < kernels::kWindowTaps; ++j) {
    const float* const d = &window_.d[(first_row + j) * kernels::kWindowStride + first_column];
    if (std::find(d, d + kernels::kWindowTaps, 0.0F) != d + kernels::kWindowTaps) return true;
  }
  return false;
}

void EdgeTile::begin_row(int row, int first, int end) {
  const auto pixel_row = static_cast<std::size_t>(row);
  const kernels::PixelRange pixels{static_cast<std::size_t>(first), static_cast<std::size_t>(end)};
  for (std::size_t b = 0; b < body_count_; ++b) {
    kernels::blur_columns(window_, taps_, pixel_row, pixels, static_cast<float>(bodies_[b]),
                          columns_[b]);
  }
  kernels::blur_squares(window_, taps_, pixel_row, pixels, reference_, squares_);
}

void EdgeTile::look_at(int column) {
  const auto pixel = static_cast<std::size_t>(column);
  mean_ = 0.0F;
  for (std::size_t b = 0; b < body_count_; ++b) {
    const kernels::ColumnMoments& sums = columns_[b];
    moments_[b] = {blur(sums.d, taps_.at_samples, pixel),
                   blur(sums.d_squared, taps_.at_samples, pixel),
                   blur(sums.step_u, taps_.between_samples, pixel),
                   blur(sums.step_u_d, taps_.between_samples, pixel),
                   blur(sums.step_v, taps_.at_samples, pixel),
                   blur(sums.step_v_d, taps_.at_samples, pixel)};
    mean_ += moments_[b].d;
  }
  const float offset = mean_ - reference_;
  variance_ = std::max(0.0F, blur(squares_, taps_.at_samples, pixel) - offset * offset);
}

/// A point p = (x z, y z, z) moves with v + w x p under its body's twist (v, w): d = 1 / z by
/// -d^2 v_z - d (y w_x - x w_y), and its ray with the rest times d.
Eigen::Matrix<float, 6, 1> EdgeTile::derivative(std::size_t body, float x, float y,
                                                const PinholeCamera& camera) const {
  const Moments& moments = moments_[body];
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const float u = fx * moments.step_u;
  const float ud = fx * moments.step_u_d;
  const float v = fy * moments.step_v;
  const float vd = fy * moments.step_v_d;
  const float d = moments.d;
  Eigen::Matrix<float, 6, 1> result;
  result << -ud, -vd, -moments.d_squared + x * ud + y * vd, -y * d + x * y * u + (1.0F + y * y) * v,
      x * d - (1.0F + x * x) * u - x * y * v, y * u - x * v;
  return result;
}

}  // namespace lockbox
