// SPDX-License-Identifier: BSD-3-Clause
// The columns of a row, many at once. To be included within Highway's foreach_target: once for each
// instruction set.
#if defined(LOCKBOX_KERNELS_COLUMNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_COLUMNS_INL
#undef LOCKBOX_KERNELS_COLUMNS_INL
#else
#define LOCKBOX_KERNELS_COLUMNS_INL
#endif

#include "hwy/highway.h"
#include "lockbox/kernels/point_to_field.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Calls visit(tag, column) for all columns in [first, end): many at once, then one by one.
template <typename Visit>
HWY_INLINE void for_columns(std::size_t first, std::size_t end, const Visit& visit) {
  const hn::CappedTag<float, kLanes> many;
  std::size_t u = first;
  for (; u + hn::Lanes(many) <= end; u += hn::Lanes(many)) visit(many, u);
  for (; u < end; ++u) visit(hn::CappedTag<float, 1>(), u);
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
