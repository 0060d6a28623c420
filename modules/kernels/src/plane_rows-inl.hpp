// SPDX-License-Identifier: BSD-3-Clause
// Where the rows of a z-buffer show a plane. To be included within Highway's foreach_target: once
// for each instruction set.
#if defined(LOCKBOX_KERNELS_PLANE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_PLANE_ROWS_INL
#undef LOCKBOX_KERNELS_PLANE_ROWS_INL
#else
#define LOCKBOX_KERNELS_PLANE_ROWS_INL
#endif

#include "hwy/highway.h"
#include "lockbox/kernels/contours.hpp"

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

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
