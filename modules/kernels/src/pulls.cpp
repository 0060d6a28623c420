// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/pulls.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pulls.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/contrib/math/math-inl.h"
#include "normal_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

struct Residuals {
  Float p[3];
  Float direction[3];
  Float residual;
  Float inverse_variance;
  Float gaussian;  // exp(-residual^2 / (2 variance))
};

HWY_INLINE Residuals residuals_of(const PullSpan& pulls, std::size_t i,
                                  const RigidMotion& camera_from_body, const PullLoss& loss) {
  const FloatTag df;
  Residuals result;
  load(pulls.p, i, result.p);
  load(pulls.direction, i, result.direction);
  Float target[3];
  load(pulls.target, i, target);
  Float off[3];
  transform(camera_from_body, result.p, off);
  for (int axis = 0; axis < 3; ++axis) off[axis] = hn::Sub(off[axis], target[axis]);
  result.residual = dot(result.direction, off);
  result.inverse_variance = hn::Div(
      hn::Set(df, 1.0F), hn::Add(hn::LoadU(df, pulls.variance + i), hn::Set(df, loss.spread2)));
  const Float half = hn::Mul(hn::Set(df, -0.5F), hn::Mul(hn::Mul(result.residual, result.residual),
                                                         result.inverse_variance));
  result.gaussian = hn::Exp(df, hn::Max(half, hn::Set(df, -80.0F)));  // exp of less is no float
  return result;
}

NormalSums accumulate_pulls_lanes(const PullSpan& pulls, const RigidMotion& camera_from_body,
                                  const PullLoss& loss) {
  const FloatTag df;
  const Float outlier = hn::Set(df, std::exp(-0.5F * loss.cut * loss.cut));
  NormalSumLanes lanes;
  lanes.set_zero();
  MomentLanes feigned;
  feigned.set_zero();
  for (std::size_t i = 0; i < pulls.size; i += hn::Lanes(df)) {
    const Residuals at = residuals_of(pulls, i, camera_from_body, loss);
    const Float share = hn::Div(at.gaussian, hn::Add(at.gaussian, outlier));
    const Float w = hn::Mul(hn::LoadU(df, pulls.pixels + i), hn::Mul(share, at.inverse_variance));
    Float n[3];
    rotate_back(camera_from_body, at.direction, n);
    lanes.add(at.p, n, w, hn::Neg(hn::Mul(w, at.residual)));
    feigned.add(at.p, hn::Mul(w, hn::LoadU(df, pulls.direction_variance + i)));
  }
  NormalSums sums{};
  lanes.write(sums);
  feigned.write(sums);
  return sums;
}

double pull_cost_lanes(const PullSpan& pulls, const RigidMotion& camera_from_body,
                       const PullLoss& loss) {
  const FloatTag df;
  const float outlier_cost = 0.5F * loss.cut * loss.cut;
  const Float outlier = hn::Set(df, std::exp(-outlier_cost));
  Float total = hn::Zero(df);
  for (std::size_t i = 0; i < pulls.size; i += hn::Lanes(df)) {
    const Residuals at = residuals_of(pulls, i, camera_from_body, loss);
    const Float gain =
        hn::Add(hn::Log(df, hn::Add(at.gaussian, outlier)), hn::Set(df, outlier_cost));
    total = hn::NegMulAdd(hn::LoadU(df, pulls.pixels + i), gain, total);
  }
  return sum_of_lanes(total);
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(accumulate_pulls_lanes);
HWY_EXPORT(pull_cost_lanes);

NormalSums accumulate_pulls(const PullSpan& pulls, const RigidMotion& camera_from_body,
                            const PullLoss& loss) {
  return HWY_DYNAMIC_DISPATCH(accumulate_pulls_lanes)(pulls, camera_from_body, loss);
}

double pull_cost(const PullSpan& pulls, const RigidMotion& camera_from_body, const PullLoss& loss) {
  return HWY_DYNAMIC_DISPATCH(pull_cost_lanes)(pulls, camera_from_body, loss);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
