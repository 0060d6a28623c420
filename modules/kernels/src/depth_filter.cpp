// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/depth_filter.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "depth_filter.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "columns-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

void scale_units(const std::uint16_t* units, const std::size_t count, const float metres_per_unit,
                 float* metres) {
  for_columns(0, count, [&](auto df, std::size_t i) HWY_ATTR {
    const hn::RebindToSigned<decltype(df)> di;
    const hn::Rebind<std::uint16_t, decltype(df)> du;
    const auto depth = hn::ConvertTo(df, hn::PromoteTo(di, hn::LoadU(du, units + i)));
    hn::StoreU(hn::Mul(depth, hn::Set(df, metres_per_unit)), df, metres + i);
  });
}

/// An unmeasured neighbour says nothing.
template <typename D, typename V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> hangs_between(const D df, const V before, const V depth, const V after,
                                     const V jump) {
  const V nothing = hn::Zero(df);
  const auto are_measured = hn::And(hn::Gt(before, nothing), hn::Gt(after, nothing));
  const V least = hn::Min(hn::Abs(hn::Sub(depth, before)), hn::Abs(hn::Sub(depth, after)));
  return hn::And(are_measured, hn::Gt(least, jump));
}

void filter_row(const DepthRows& depths, const std::size_t width, const DepthFilter& filter,
                float* kept) {
  for_columns(0, width, [&](auto df, std::size_t u) HWY_ATTR {
    const auto depth = hn::LoadU(df, depths.here + u);
    const auto jump = hn::Mul(hn::Set(df, filter.jump_factor), hn::Mul(depth, depth));
    const auto in_row = hangs_between(df, hn::LoadU(df, depths.here + u - 1), depth,
                                      hn::LoadU(df, depths.here + u + 1), jump);
    const auto in_column = hangs_between(df, hn::LoadU(df, depths.above + u), depth,
                                         hn::LoadU(df, depths.below + u), jump);
    const auto in_range = hn::And(hn::Ge(depth, hn::Set(df, filter.min_depth)),
                                  hn::Le(depth, hn::Set(df, filter.max_depth)));
    const auto is_kept = hn::AndNot(hn::Or(in_row, in_column), in_range);
    hn::StoreU(hn::IfThenElseZero(is_kept, depth), df, kept + u);
  });
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(scale_units);
HWY_EXPORT(filter_row);

void scale_depths(const std::uint16_t* units, std::size_t count, float metres_per_unit,
                  float* metres) {
  HWY_DYNAMIC_DISPATCH(scale_units)(units, count, metres_per_unit, metres);
}

void filter_depths(const DepthRows& depths, std::size_t width, const DepthFilter& filter,
                   float* kept) {
  HWY_DYNAMIC_DISPATCH(filter_row)(depths, width, filter, kept);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
