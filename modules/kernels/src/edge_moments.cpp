// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/edge_moments.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "edge_moments.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kWindowStride>;
using Vector = hn::Vec<Tag>;

/// The first column of samples that a pixel looks at, or where the vector begins that holds it.
HWY_INLINE std::size_t first_column(const PixelRange& pixels) {
  return kSamplesPerPixel * pixels.first / hn::Lanes(Tag()) * hn::Lanes(Tag());
}

HWY_INLINE std::size_t end_column(const PixelRange& pixels) {
  return kSamplesPerPixel * (pixels.end - 1) + kWindowTaps;
}

/// Adds the steps from samples to those `next` after them that a body moves.
HWY_INLINE void add_steps(const float* const d, const float* const body, const std::size_t next,
                          const Vector of_body, const Vector tap, Vector& step, Vector& step_d) {
  const Tag tag;
  const auto here = hn::LoadU(tag, d);
  const auto there = hn::LoadU(tag, d + next);
  const auto nearer =
      hn::IfThenElse(hn::Gt(there, here), hn::LoadU(tag, body + next), hn::LoadU(tag, body));
  const auto weighted = hn::Mul(tap, hn::Sub(there, here));
  const auto moved = hn::IfThenElseZero(hn::Eq(nearer, of_body), weighted);
  step = hn::Add(step, moved);
  step_d = hn::MulAdd(moved, hn::Max(here, there), step_d);
}

void blur_columns_of(const EdgeWindow& window, const WindowTaps& taps, const std::size_t pixel_row,
                     const PixelRange& pixels, const float body, ColumnMoments& moments) {
  const Tag tag;
  const auto of_body = hn::Set(tag, body);
  const auto rate = hn::Set(tag, static_cast<float>(kSamplesPerPixel));
  // Of a row, the last sample has no neighbour; what becomes of it there is not used.
  for (std::size_t i = first_column(pixels); i < end_column(pixels); i += hn::Lanes(tag)) {
    auto sum = hn::Zero(tag);
    auto squares = hn::Zero(tag);
    auto step_u = hn::Zero(tag);
    auto step_u_d = hn::Zero(tag);
    auto step_v = hn::Zero(tag);
    auto step_v_d = hn::Zero(tag);
    for (std::size_t t = 0; t < kWindowTaps; ++t) {
      const std::size_t at = (kSamplesPerPixel * pixel_row + t) * kWindowStride + i;
      const float* const d = &window.d[at];
      const float* const bodies = &window.body[at];
      const auto tap = hn::Set(tag, taps.at_samples[t]);
      const auto own =
          hn::IfThenElseZero(hn::Eq(hn::LoadU(tag, bodies), of_body), hn::LoadU(tag, d));
      const auto weighted = hn::Mul(tap, own);
      sum = hn::Add(sum, weighted);
      squares = hn::MulAdd(weighted, own, squares);
      const auto between = hn::Set(tag, taps.between_samples[t]);
      add_steps(d, bodies, 1, of_body, tap, step_u, step_u_d);
      add_steps(d, bodies, kWindowStride, of_body, between, step_v, step_v_d);
    }
    hn::StoreU(sum, tag, &moments.d[i]);
    hn::StoreU(squares, tag, &moments.d_squared[i]);
    hn::StoreU(hn::Mul(rate, step_u), tag, &moments.step_u[i]);
    hn::StoreU(hn::Mul(rate, step_u_d), tag, &moments.step_u_d[i]);
    hn::StoreU(hn::Mul(rate, step_v), tag, &moments.step_v[i]);
    hn::StoreU(hn::Mul(rate, step_v_d), tag, &moments.step_v_d[i]);
  }
}

void blur_squares_of(const EdgeWindow& window, const WindowTaps& taps, const std::size_t pixel_row,
                     const PixelRange& pixels, const float reference,
                     ColumnMoments::Sums& squares) {
  const Tag tag;
  const auto zero = hn::Set(tag, reference);
  for (std::size_t i = first_column(pixels); i < end_column(pixels); i += hn::Lanes(tag)) {
    auto sum = hn::Zero(tag);
    for (std::size_t t = 0; t < kWindowTaps; ++t) {
      const std::size_t at = (kSamplesPerPixel * pixel_row + t) * kWindowStride + i;
      const auto offset = hn::Sub(hn::LoadU(tag, &window.d[at]), zero);
      sum = hn::MulAdd(hn::Mul(hn::Set(tag, taps.at_samples[t]), offset), offset, sum);
    }
    hn::StoreU(sum, tag, &squares[i]);
  }
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(blur_columns_of);
HWY_EXPORT(blur_squares_of);

void blur_columns(const EdgeWindow& window, const WindowTaps& taps, std::size_t pixel_row,
                  const PixelRange& pixels, float body, ColumnMoments& moments) {
  HWY_DYNAMIC_DISPATCH(blur_columns_of)(window, taps, pixel_row, pixels, body, moments);
}

void blur_squares(const EdgeWindow& window, const WindowTaps& taps, std::size_t pixel_row,
                  const PixelRange& pixels, float reference, ColumnMoments::Sums& squares) {
  HWY_DYNAMIC_DISPATCH(blur_squares_of)(window, taps, pixel_row, pixels, reference, squares);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
