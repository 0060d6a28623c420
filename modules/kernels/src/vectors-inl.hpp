// SPDX-License-Identifier: BSD-3-Clause
// Vectors of three numbers, lane by lane. To be included within Highway's foreach_target: once for
// each instruction set.
#if defined(LOCKBOX_KERNELS_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_VECTORS_INL
#undef LOCKBOX_KERNELS_VECTORS_INL
#else
#define LOCKBOX_KERNELS_VECTORS_INL
#endif

#include "hwy/highway.h"
#include "lockbox/kernels/point_to_field.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most kLanes lanes, also where vectors are longer.
using FloatTag = hn::CappedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Float = hn::Vec<FloatTag>;
using Int = hn::Vec<IntTag>;

HWY_INLINE void load(const float* const axes[3], const std::size_t i, Float vector[3]) {
  for (int axis = 0; axis < 3; ++axis) vector[axis] = hn::LoadU(FloatTag(), axes[axis] + i);
}

HWY_INLINE void load(const PointSpan& points, const std::size_t i, Float p[3]) {
  const float* const axes[3] = {points.x, points.y, points.z};
  load(axes, i, p);
}

HWY_INLINE void store(const Float vector[3], float* const axes[3], const std::size_t i) {
  for (int axis = 0; axis < 3; ++axis) hn::StoreU(vector[axis], FloatTag(), axes[axis] + i);
}

HWY_INLINE Float dot(const Float a[3], const Float b[3]) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

/// rotation * v + offset.
HWY_INLINE void rotate(const RigidMotion& motion, const Float v[3], const float offset[3],
                       Float result[3]) {
  const FloatTag df;
  for (int row = 0; row < 3; ++row) {
    const float* r = motion.rotation + static_cast<std::ptrdiff_t>(3) * row;
    result[row] =
        hn::MulAdd(hn::Set(df, r[0]), v[0],
                   hn::MulAdd(hn::Set(df, r[1]), v[1],
                              hn::MulAdd(hn::Set(df, r[2]), v[2], hn::Set(df, offset[row]))));
  }
}

/// A point.
HWY_INLINE void transform(const RigidMotion& motion, const Float p[3], Float result[3]) {
  rotate(motion, p, motion.translation, result);
}

/// A direction of the frame that the motion leads to, in the one that it comes from.
HWY_INLINE void rotate_back(const RigidMotion& motion, const Float v[3], Float result[3]) {
  const FloatTag df;
  for (int column = 0; column < 3; ++column) {
    const Float r[3] = {hn::Set(df, motion.rotation[column]),
                        hn::Set(df, motion.rotation[3 + column]),
                        hn::Set(df, motion.rotation[6 + column])};
    result[column] = dot(r, v);
  }
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
