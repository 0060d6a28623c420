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

using Tag = hn::CappedTag<float, kWindowSide>;
using Vector = hn::Vec<Tag>;
using Bodies = hn::RebindToSigned<Tag>;

HWY_INLINE hn::Vec<Bodies> load_bodies(const std::int16_t* const body) {
  return hn::PromoteTo(Bodies(), hn::LoadU(hn::Rebind<std::int16_t, Tag>(), body));
}

HWY_INLINE std::size_t end_column(const PixelRange& pixels) {
  return kSamplesPerPixel * (pixels.end - 1) + kWindowTaps;
}

/// The first column of samples that a pixel looks at, or before it, so that whole vectors from
/// there on stay within the window.
HWY_INLINE std::size_t first_column(const PixelRange& pixels) {
  const std::size_t lanes = hn::Lanes(Tag());
  const std::size_t first = kSamplesPerPixel * pixels.first;
  const std::size_t vectors = (end_column(pixels) - first + lanes - 1) / lanes;
  return HWY_MIN(first, kWindowSide - vectors * lanes);
}

/// Adds the steps from samples to those `next` after them that a body moves.
HWY_INLINE void add_steps(const float* const d, const std::int16_t* const body,
                          const std::size_t next, const hn::Vec<Bodies> of_body, const Vector tap,
                          Vector& step, Vector& step_d) {
  const Tag tag;
  const auto here = hn::LoadU(tag, d);
  const auto there = hn::LoadU(tag, d + next);
  const auto nearer = hn::IfThenElse(hn::RebindMask(Bodies(), hn::Gt(there, here)),
                                     load_bodies(body + next), load_bodies(body));
  const auto weighted = hn::Mul(tap, hn::Sub(there, here));
  const auto moved = hn::IfThenElseZero(hn::RebindMask(tag, hn::Eq(nearer, of_body)), weighted);
  step = hn::Add(step, moved);
  step_d = hn::MulAdd(moved, hn::Max(here, there), step_d);
}

void blur_columns_of(const EdgeWindow& window, const WindowTaps& taps, const std::size_t pixel_row,
                     const PixelRange& pixels, const std::int16_t body, ColumnMoments& moments) {
  const Tag tag;
  const auto of_body = hn::Set(Bodies(), body);
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
      const std::size_t at = (kSamplesPerPixel * pixel_row + t) * window.stride + i;
      const float* const d = window.d + at;
      const std::int16_t* const bodies = window.body + at;
      const auto tap = hn::Set(tag, taps.at_samples[t]);
      const auto is_own = hn::RebindMask(tag, hn::Eq(load_bodies(bodies), of_body));
      const auto own = hn::IfThenElseZero(is_own, hn::LoadU(tag, d));
      const auto weighted = hn::Mul(tap, own);
      sum = hn::Add(sum, weighted);
      squares = hn::MulAdd(weighted, own, squares);
      const auto between = hn::Set(tag, taps.between_samples[t]);
      add_steps(d, bodies, 1, of_body, tap, step_u, step_u_d);
      add_steps(d, bodies, window.stride, of_body, between, step_v, step_v_d);
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
      const std::size_t at = (kSamplesPerPixel * pixel_row + t) * window.stride + i;
      const auto offset = hn::Sub(hn::LoadU(tag, window.d + at), zero);
      sum = hn::MulAdd(hn::Mul(hn::Set(tag, taps.at_samples[t]), offset), offset, sum);
    }
    hn::StoreU(sum, tag, &squares[i]);
  }
}

/// Inverse depth is linear in the image of a plane.
std::uint32_t find_bending_in_row(const EdgeWindow& window, const std::size_t pixel_row,
                                  const float least) {
  const hn::CappedTag<float, kWindowPixels> tag;
  constexpr std::size_t kCentre = kWindowTaps / 2;
  const float* const centre =
      window.d + (kCentre + kSamplesPerPixel * pixel_row) * window.stride + kCentre;
  const auto every_third = [&](const float* d) HWY_ATTR {
    static_assert(kSamplesPerPixel == 3);
    hn::Vec<decltype(tag)> first;
    hn::Vec<decltype(tag)> second;
    hn::Vec<decltype(tag)> third;
    hn::LoadInterleaved3(tag, d, first, second, third);
    return first;
  };
  std::uint32_t bits = 0;
  for (std::size_t column = 0; column < kWindowPixels; column += hn::Lanes(tag)) {
    const float* const d = centre + kSamplesPerPixel * column;
    const auto here = every_third(d);
    const auto left = every_third(d - kSamplesPerPixel);
    const auto right = every_third(d + kSamplesPerPixel);
    const auto above = every_third(d - kSamplesPerPixel * window.stride);
    const auto below = every_third(d + kSamplesPerPixel * window.stride);
    const auto farthest = hn::Min(here, hn::Min(hn::Min(left, right), hn::Min(above, below)));
    const auto bend = [&](auto before, auto after) HWY_ATTR {
      return hn::Abs(hn::NegMulAdd(hn::Set(tag, 2.0F), here, hn::Add(before, after)));
    };
    const auto bends = hn::Gt(hn::Max(bend(left, right), bend(above, below)), hn::Set(tag, least));
    const auto found = hn::And(bends, hn::Gt(farthest, hn::Zero(tag)));
    std::uint8_t mask[8] = {};
    hn::StoreMaskBits(tag, found, mask);
    bits |= static_cast<std::uint32_t>(mask[0]) << column;
  }
  return bits;
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(blur_columns_of);
HWY_EXPORT(blur_squares_of);
HWY_EXPORT(find_bending_in_row);

void blur_columns(const EdgeWindow& window, const WindowTaps& taps, std::size_t pixel_row,
                  const PixelRange& pixels, std::int16_t body, ColumnMoments& moments) {
  HWY_DYNAMIC_DISPATCH(blur_columns_of)(window, taps, pixel_row, pixels, body, moments);
}

void blur_squares(const EdgeWindow& window, const WindowTaps& taps, std::size_t pixel_row,
                  const PixelRange& pixels, float reference, ColumnMoments::Sums& squares) {
  HWY_DYNAMIC_DISPATCH(blur_squares_of)(window, taps, pixel_row, pixels, reference, squares);
}

std::uint32_t find_bending(const EdgeWindow& window, std::size_t pixel_row, float least) {
  return HWY_DYNAMIC_DISPATCH(find_bending_in_row)(window, pixel_row, least);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
