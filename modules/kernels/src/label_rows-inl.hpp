// SPDX-License-Identifier: BSD-3-Clause
// What pixels of a z-buffer and their neighbours show. To be included within Highway's
// foreach_target: once for each instruction set.
#if defined(LOCKBOX_KERNELS_LABEL_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_LABEL_ROWS_INL
#undef LOCKBOX_KERNELS_LABEL_ROWS_INL
#else
#define LOCKBOX_KERNELS_LABEL_ROWS_INL
#endif

#include "hwy/highway.h"
#include "lockbox/kernels/contours.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether one of its four neighbours shows something else than the pixel in column u, and those
/// after it.
template <typename D>
HWY_INLINE hn::Mask<D> shows_others_beside(const D df, const LabelRows& labels,
                                           const std::size_t u) {
  const hn::Rebind<std::int16_t, D> ds;
  const auto label = hn::LoadU(ds, labels.here + u);
  const auto other = [&](const std::int16_t* neighbour)
                         HWY_ATTR { return hn::Xor(label, hn::LoadU(ds, neighbour)); };
  const auto others = hn::Or(hn::Or(other(labels.here + u - 1), other(labels.here + u + 1)),
                             hn::Or(other(labels.above + u), other(labels.below + u)));
  const hn::RebindToSigned<D> di;
  return hn::RebindMask(df, hn::Ne(hn::PromoteTo(di, others), hn::Zero(di)));
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
