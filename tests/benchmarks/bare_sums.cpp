// SPDX-License-Identifier: BSD-3-Clause
#include "bare_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bare_sums.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"
#include "normal_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

NormalSums bare_point_sums(const FieldView& field, const RigidMotion& motion,
                           const PointSpan& points) {
  const FloatTag df;
  NormalSumLanes lanes;
  lanes.set_zero();
  Float squares = hn::Zero(df);
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
    Float q[3];
    Float n[3];
    transform(motion, p, q);
    const GridPosition at = locate(field, q);
    const Float distance = interpolate<true>(field, at, n);
    const Float w = hn::IfThenElseZero(at.inside, hn::Set(df, 1.0F));
    const Float wd = hn::IfThenElseZero(at.inside, distance);
    lanes.add(q, n, w, wd);
    squares = hn::MulAdd(wd, distance, squares);
  }
  NormalSums sums{};
  lanes.write(sums);
  sums.weighted_squares = sum_of_lanes(squares);
  return sums;
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(bare_point_sums);

NormalSums bare_sums(const FieldView& field, const RigidMotion& body_from_camera,
                     const PointSpan& points) {
  return HWY_DYNAMIC_DISPATCH(bare_point_sums)(field, body_from_camera, points);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
