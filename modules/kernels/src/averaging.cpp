// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/averaging.hpp"

#include <algorithm>

#include "lockbox/kernels/point_to_field.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "averaging.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rows from one to the next that the first mean is taken of: it only tells where the second looks.
/// Of all of them if these show nothing.
constexpr std::size_t kRowsApart = 4;

/// Calls visit(deviation) for all pixels of these rows, many at once; unmeasured ones deviate by
/// -1.
template <typename D, typename Visit>
HWY_INLINE void for_each_deviation(const D df, const DepthBlock& block, const NearnessPlane& plane,
                                   std::size_t rows_apart, const Visit& visit) {
  for (std::size_t row = 0; row < block.height; row += rows_apart) {
    const float* const depths = block.first + row * block.stride;
    const auto first = hn::Set(df, plane.first + plane.per_row * static_cast<float>(row));
    for (std::size_t column = 0; column < block.width; column += hn::Lanes(df)) {
      const auto z = hn::LoadU(df, depths + column);
      const auto nearness = hn::MulAdd(hn::Set(df, plane.per_column),
                                       hn::Iota(df, static_cast<float>(column)), first);
      visit(hn::MulSub(z, nearness, hn::Set(df, 1.0F)));
    }
  }
}

struct FirstMean {
  float pixels;
  float deviation;
};

/// Of the pixels within reach of the plane.
template <typename D>
FirstMean first_mean(const D df, const DepthBlock& block, const NearnessPlane& plane, float reach,
                     std::size_t rows_apart) {
  auto count = hn::Zero(df);
  auto sum = hn::Zero(df);
  for_each_deviation(df, block, plane, rows_apart, [&](auto deviation) HWY_ATTR {
    const auto is_near = hn::Lt(hn::Abs(deviation), hn::Set(df, reach));
    count = hn::Add(count, hn::IfThenElseZero(is_near, hn::Set(df, 1.0F)));
    sum = hn::Add(sum, hn::IfThenElseZero(is_near, deviation));
  });
  const float pixels = hn::GetLane(hn::SumOfLanes(df, count));
  return {pixels, hn::GetLane(hn::SumOfLanes(df, sum)) / std::max(pixels, 1.0F)};
}

/// Lanes: of vectors, at most; divides the block's width.
template <std::size_t Lanes>
AveragedDeviation average_by(const DepthBlock& block, const NearnessPlane& plane, float reach,
                             float gate) {
  const hn::CappedTag<float, Lanes> df;
  const auto total = [df](auto lanes) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(df, lanes)); };
  FirstMean first = first_mean(df, block, plane, reach, kRowsApart);
  if (first.pixels == 0.0F) first = first_mean(df, block, plane, reach, 1);
  if (first.pixels == 0.0F) return {};
  const float center = first.deviation;
  auto squares = hn::Zero(df);
  auto count = hn::Zero(df);
  auto sum = hn::Zero(df);
  for_each_deviation(df, block, plane, 1, [&](auto deviation) HWY_ATTR {
    const auto off = hn::Sub(deviation, hn::Set(df, center));
    const auto is_near = hn::Lt(hn::Abs(off), hn::Set(df, gate));
    const auto counted = hn::IfThenElseZero(is_near, off);
    count = hn::Add(count, hn::IfThenElseZero(is_near, hn::Set(df, 1.0F)));
    sum = hn::Add(sum, counted);
    squares = hn::MulAdd(counted, counted, squares);
  });
  const float pixels = total(count);
  if (pixels == 0.0F) return {};
  const float off = total(sum) / pixels;
  return {pixels, center + off, std::max(0.0F, total(squares) / pixels - off * off)};
}

AveragedDeviation average_block(const DepthBlock& block, const NearnessPlane& plane, float reach,
                                float gate) {
  if (block.width % kLanes == 0) return average_by<kLanes>(block, plane, reach, gate);
  if (block.width % 8 == 0) return average_by<8>(block, plane, reach, gate);
  if (block.width % 4 == 0) return average_by<4>(block, plane, reach, gate);
  if (block.width % 2 == 0) return average_by<2>(block, plane, reach, gate);
  return average_by<1>(block, plane, reach, gate);
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(average_block);

AveragedDeviation average_deviations(const DepthBlock& block, const NearnessPlane& plane,
                                     float reach, float gate) {
  return HWY_DYNAMIC_DISPATCH(average_block)(block, plane, reach, gate);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
