// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/edge_patch.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

using Taps = std::array<float, kernels::kWindowTaps>;

/// Samples along each side of a window that pixels look at.
constexpr std::size_t kSeen =
    kernels::kSamplesPerPixel * (kernels::kWindowPixels - 1) + kernels::kWindowTaps + 1;

/// Gaussian density around a pixel's centre, at points `shift` of their distance after the samples.
Taps jitter_density(double lateral_pixels, double shift) {
  const double sigma = EdgePatch::kSamples * std::max(lateral_pixels, 1e-3);
  std::array<double, kernels::kWindowTaps> weights{};
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double offset = (static_cast<double>(i) - EdgePatch::kReach + shift) / sigma;
    weights[i] = std::exp(-0.5 * offset * offset);
    sum += weights[i];
  }
  Taps taps{};
  std::transform(weights.begin(), weights.end(), taps.begin(),
                 [sum](double weight) { return static_cast<float>(weight / sum); });
  return taps;
}

/// Blurs over the samples around the pixel of a column.
float blur(const kernels::ColumnMoments::Sums& columns, const Taps& taps, std::size_t pixel) {
  using Weights = Eigen::Matrix<float, static_cast<int>(kernels::kWindowTaps), 1>;
  const float* const around = &columns[kernels::kSamplesPerPixel * pixel];
  return Eigen::Map<const Weights>(taps.data()).dot(Eigen::Map<const Weights>(around));
}

}  // namespace

EdgePatch::EdgePatch(double lateral_pixels)
    : taps_{jitter_density(lateral_pixels, 0.0), jitter_density(lateral_pixels, 0.5)} {}

bool EdgePatch::read(const RenderedInverseDepth& samples, int left, int top) {
  const auto stride = static_cast<std::size_t>(samples.width);
  const std::size_t first = static_cast<std::size_t>(top) * stride + static_cast<std::size_t>(left);
  window_ = {&samples.inverse_depth[first], &samples.id[first], stride};
  reference_ = window_.d[kSeen / 2 * (stride + 1)];
  return find_bodies();
}

/// Most rows are as that above.
bool EdgePatch::find_bodies() {
  body_count_ = 0;
  shows_nothing_ = false;
  for (std::size_t j = 0; j < kSeen; ++j) {
    const std::int16_t* const ids = window_.body + j * window_.stride;
    if (j > 0 && std::equal(ids, ids + kSeen, ids - window_.stride)) continue;
    for (std::size_t i = 0; i < kSeen; ++i) {
      if ((i == 0 || ids[i] != ids[i - 1]) && !add_body(ids[i])) return false;
    }
  }
  return body_count_ > 0;
}

/// False if there are too many.
bool EdgePatch::add_body(std::int16_t body) {
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

std::uint32_t EdgePatch::bending(int row, float least) const {
  return kernels::find_bending(window_, static_cast<std::size_t>(row), least);
}

bool EdgePatch::may_show_nothing(int column, int row) const {
  if (!shows_nothing_) return false;
  const auto first_column = static_cast<std::size_t>(kSamples * column);
  const auto first_row = static_cast<std::size_t>(kSamples * row);
  for (std::size_t j = 0; j < kernels::kWindowTaps; ++j) {
    const float* const d = window_.d + (first_row + j) * window_.stride + first_column;
    if (std::find(d, d + kernels::kWindowTaps, 0.0F) != d + kernels::kWindowTaps) return true;
  }
  return false;
}

void EdgePatch::begin_row(int row, int first, int end) {
  const auto pixel_row = static_cast<std::size_t>(row);
  const kernels::PixelRange pixels{static_cast<std::size_t>(first), static_cast<std::size_t>(end)};
  for (std::size_t b = 0; b < body_count_; ++b) {
    kernels::blur_columns(window_, taps_, pixel_row, pixels, bodies_[b], columns_[b]);
  }
  kernels::blur_squares(window_, taps_, pixel_row, pixels, reference_, squares_);
}

void EdgePatch::look_at(int column) {
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
Eigen::Matrix<float, 6, 1> EdgePatch::derivative(std::size_t body, float x, float y,
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
