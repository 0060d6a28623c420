// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/flatness.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "flatness.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"
#include "label_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// |1 / before + 1 / after - 2 / z| within the bend, without a division.
template <typename D, typename V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> is_straight(const D df, const V z, const float* before, const float* after,
                                   const float bend) {
  const V a = hn::LoadU(df, before);
  const V b = hn::LoadU(df, after);
  const V product = hn::Mul(a, b);
  const V bends = hn::NegMulAdd(hn::Set(df, 2.0F), product, hn::Mul(z, hn::Add(a, b)));
  return hn::Le(hn::Abs(bends), hn::Mul(hn::Mul(hn::Set(df, bend), z), product));
}

template <typename D>
HWY_INLINE hn::Mask<D> is_plane(const D df, const DepthRows& depths, const std::size_t u,
                                const float bend) {
  const auto z = hn::LoadU(df, depths.here + u);
  return hn::And(is_straight(df, z, depths.here + u - 1, depths.here + u + 1, bend),
                 is_straight(df, z, depths.above + u, depths.below + u, bend));
}

/// Of the pixels and their neighbours in row and column.
template <typename D>
HWY_INLINE hn::Vec<D> farthest(const D df, const DepthRows& depths, const std::size_t u) {
  const auto in_row =
      hn::Max(hn::LoadU(df, depths.here + u - 1), hn::LoadU(df, depths.here + u + 1));
  const auto in_column = hn::Max(hn::LoadU(df, depths.above + u), hn::LoadU(df, depths.below + u));
  return hn::Max(hn::LoadU(df, depths.here + u), hn::Max(in_row, in_column));
}

/// Stores one byte of 0 or 1 for each of the lanes' pixels.
template <typename D>
HWY_INLINE void store_bytes(const D /*df*/, const hn::Mask<D> mask, std::uint8_t* bytes) {
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint8_t, D> db;
  const auto ones = hn::IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, 1));
  hn::StoreU(hn::DemoteTo(db, ones), db, bytes);
}

/// Calls visit(tag, column) for all columns in [first, end): many at once, then one by one.
template <typename Visit>
HWY_INLINE void for_columns(std::size_t first, std::size_t end, const Visit& visit) {
  const hn::CappedTag<float, kLanes> many;
  std::size_t u = first;
  for (; u + hn::Lanes(many) <= end; u += hn::Lanes(many)) visit(many, u);
  for (; u < end; ++u) visit(hn::CappedTag<float, 1>(), u);
}

void find_flat_in_row(const DepthRows& depths, const LabelRows& labels, std::size_t first,
                      std::size_t end, float bend, std::uint8_t* flat) {
  for_columns(first, end, [&](auto df, std::size_t u) HWY_ATTR {
    const hn::Rebind<std::int16_t, decltype(df)> ds;
    const hn::RebindToSigned<decltype(df)> di;
    const auto shows_body =
        hn::Gt(hn::PromoteTo(di, hn::LoadU(ds, labels.here + u)), hn::Set(di, -1));
    const auto is_one_body =
        hn::AndNot(shows_others_beside(df, labels, u), hn::RebindMask(df, shows_body));
    store_bytes(df, hn::And(is_plane(df, depths, u, bend), is_one_body), flat + (u - first));
  });
}

void find_bends_in_row(const DepthRows& depths, std::size_t first, std::size_t end, float bend,
                       std::uint8_t* bends) {
  for_columns(first, end, [&](auto df, std::size_t u) HWY_ATTR {
    const auto show_something =
        hn::Lt(farthest(df, depths, u), hn::Set(df, std::numeric_limits<float>::infinity()));
    store_bytes(df, hn::AndNot(is_plane(df, depths, u, bend), show_something), bends + (u - first));
  });
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(find_flat_in_row);
HWY_EXPORT(find_bends_in_row);

void find_flat(const DepthRows& depths, const LabelRows& labels, std::size_t first, std::size_t end,
               float bend, std::uint8_t* flat) {
  HWY_DYNAMIC_DISPATCH(find_flat_in_row)(depths, labels, first, end, bend, flat);
}

void find_bends(const DepthRows& depths, std::size_t first, std::size_t end, float bend,
                std::uint8_t* bends) {
  HWY_DYNAMIC_DISPATCH(find_bends_in_row)(depths, first, end, bend, bends);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
