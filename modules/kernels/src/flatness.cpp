// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/flatness.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "flatness.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "columns-inl.hpp"
#include "label_rows-inl.hpp"
#include "plane_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
/// Stores one byte of 0 or 1 for each of the lanes' pixels.
template <typename D>
HWY_INLINE void store_bytes(const D /*df*/, const hn::Mask<D> mask, std::uint8_t* bytes) {
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint8_t, D> db;
  const auto ones = hn::IfThenElseZero(hn::RebindMask(di, mask), hn::Set(di, 1));
  hn::StoreU(hn::DemoteTo(db, ones), db, bytes);
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

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(find_flat_in_row);

void find_flat(const DepthRows& depths, const LabelRows& labels, std::size_t first, std::size_t end,
               float bend, std::uint8_t* flat) {
  HWY_DYNAMIC_DISPATCH(find_flat_in_row)(depths, labels, first, end, bend, flat);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
