// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/correspondences.hpp"

#include <cmath>
#include <iterator>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "correspondences.cpp"
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

HWY_INLINE Residuals residuals_of(const CorrespondenceSpan& correspondences, std::size_t i,
                                  const RigidMotion& camera_from_body,
                                  const CorrespondenceLoss& loss) {
  const FloatTag df;
  Residuals result;
  load(correspondences.p, i, result.p);
  load(correspondences.direction, i, result.direction);
  Float target[3];
  load(correspondences.target, i, target);
  Float off[3];
  transform(camera_from_body, result.p, off);
  for (int axis = 0; axis < 3; ++axis) off[axis] = hn::Sub(off[axis], target[axis]);
  result.residual = dot(result.direction, off);
  result.inverse_variance = hn::Div(
      hn::Set(df, 1.0F),
      hn::Add(hn::LoadU(df, correspondences.variance + i), hn::Set(df, loss.annealing_variance)));
  const Float half = hn::Mul(hn::Set(df, -0.5F), hn::Mul(hn::Mul(result.residual, result.residual),
                                                         result.inverse_variance));
  result.gaussian = hn::Exp(df, hn::Max(half, hn::Set(df, -80.0F)));  // exp of less is no float
  return result;
}

/// None of the correspondences that follow the last one.
HWY_INLINE Float pixels_of(const CorrespondenceSpan& correspondences, std::size_t i) {
  const FloatTag df;
  return hn::IfThenElseZero(hn::FirstN(df, correspondences.size - i),
                            hn::LoadU(df, correspondences.pixels + i));
}

/// How much a correspondence counts by its pixels, its variance, and how likely it is to be no
/// outlier.
HWY_INLINE Float weight_of(const CorrespondenceSpan& correspondences, std::size_t i,
                           const Residuals& at, const Float outlier) {
  const Float share = hn::Div(at.gaussian, hn::Add(at.gaussian, outlier));
  return hn::Mul(pixels_of(correspondences, i), hn::Mul(share, at.inverse_variance));
}

/// Adds how much less correspondences cost than outliers.
HWY_INLINE Float add_cost(const CorrespondenceSpan& correspondences, std::size_t i,
                          const Residuals& at, const Float outlier, const float outlier_cost,
                          const Float cost) {
  const FloatTag df;
  const Float gain = hn::Add(hn::Log(df, hn::Add(at.gaussian, outlier)), hn::Set(df, outlier_cost));
  return hn::NegMulAdd(pixels_of(correspondences, i), gain, cost);
}

CorrespondenceSums accumulate_correspondences_lanes(const CorrespondenceSpan& correspondences,
                                                    const RigidMotion& camera_from_body,
                                                    const CorrespondenceLoss& loss) {
  const FloatTag df;
  const float outlier_cost = 0.5F * loss.gate * loss.gate;
  const Float outlier = hn::Set(df, std::exp(-outlier_cost));
  NormalSumLanes lanes;
  lanes.set_zero();
  MomentLanes feigned;
  feigned.set_zero();
  Float cost = hn::Zero(df);
  for (std::size_t i = 0; i < correspondences.size; i += hn::Lanes(df)) {
    const Residuals at = residuals_of(correspondences, i, camera_from_body, loss);
    const Float w = weight_of(correspondences, i, at, outlier);
    Float n[3];
    rotate_back(camera_from_body, at.direction, n);
    lanes.add(at.p, n, w, hn::Neg(hn::Mul(w, at.residual)));
    feigned.add(at.p, hn::Mul(w, hn::LoadU(df, correspondences.direction_variance + i)));
    cost = add_cost(correspondences, i, at, outlier, outlier_cost, cost);
  }
  CorrespondenceSums sums{};
  lanes.write(sums.normal);
  feigned.write(sums.normal);
  sums.cost = sum_of_lanes(cost);
  return sums;
}

/// The numbers b of correspondences, four in each array.
struct CorrespondenceRows {
  HWY_ALIGN float first[4 * padded(kMostCorrespondences)];
  HWY_ALIGN float last[4 * padded(kMostCorrespondences)];
};

/// Sums of b b' over some of them.
HWY_INLINE void multiply_run(const CorrespondenceRows& rows, std::size_t begin, std::size_t end,
                             CorrespondenceProducts& products) {
  const hn::CappedTag<float, 4> tag;
  constexpr std::size_t kRows = std::size(CorrespondenceProducts{}.rows);
  for (std::size_t column = 0; column < 8; column += hn::Lanes(tag)) {
    const float* const others = column < 4 ? rows.first + column : rows.last + column - 4;
    hn::Vec<decltype(tag)> sums[kRows];
    for (auto& sum : sums) sum = hn::Zero(tag);
    for (std::size_t i = begin; i < end; ++i) {
      const auto other = hn::LoadU(tag, others + 4 * i);
      for (std::size_t k = 0; k < kRows; ++k) {
        const float* const own = k < 4 ? rows.first + k : rows.last + k - 4;
        sums[k] = hn::MulAdd(hn::Set(tag, own[4 * i]), other, sums[k]);
      }
    }
    for (std::size_t k = 0; k < kRows; ++k) hn::StoreU(sums[k], tag, products.rows[k] + column);
  }
}

void multiply_runs_of(const CorrespondenceSpan& correspondences,
                      const RigidMotion& camera_from_body, const CorrespondenceLoss& loss,
                      const std::size_t* ends, std::size_t runs, CorrespondenceProducts* products) {
  const FloatTag df;
  const Float outlier = hn::Set(df, std::exp(-0.5F * loss.gate * loss.gate));
  CorrespondenceRows rows;
  for (std::size_t i = 0; i < correspondences.size; i += hn::Lanes(df)) {
    const Residuals at = residuals_of(correspondences, i, camera_from_body, loss);
    const Float root = hn::Sqrt(weight_of(correspondences, i, at, outlier));
    Float n[3];
    rotate_back(camera_from_body, at.direction, n);
    for (Float& axis : n) axis = hn::Mul(root, axis);
    hn::StoreInterleaved4(n[0], n[1], n[2], hn::MulSub(at.p[1], n[2], hn::Mul(at.p[2], n[1])), df,
                          rows.first + 4 * i);
    hn::StoreInterleaved4(hn::MulSub(at.p[2], n[0], hn::Mul(at.p[0], n[2])),
                          hn::MulSub(at.p[0], n[1], hn::Mul(at.p[1], n[0])),
                          hn::Mul(root, at.residual), hn::Zero(df), df, rows.last + 4 * i);
  }
  std::size_t first = 0;
  for (std::size_t run = 0; run < runs; ++run) {
    multiply_run(rows, first, ends[run], products[run]);
    first = ends[run];
  }
}

double correspondence_cost_lanes(const CorrespondenceSpan& correspondences,
                                 const RigidMotion& camera_from_body,
                                 const CorrespondenceLoss& loss) {
  const FloatTag df;
  const float outlier_cost = 0.5F * loss.gate * loss.gate;
  const Float outlier = hn::Set(df, std::exp(-outlier_cost));
  Float cost = hn::Zero(df);
  for (std::size_t i = 0; i < correspondences.size; i += hn::Lanes(df)) {
    const Residuals at = residuals_of(correspondences, i, camera_from_body, loss);
    cost = add_cost(correspondences, i, at, outlier, outlier_cost, cost);
  }
  return sum_of_lanes(cost);
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(accumulate_correspondences_lanes);
HWY_EXPORT(multiply_runs_of);
HWY_EXPORT(correspondence_cost_lanes);

CorrespondenceSums accumulate_correspondences(const CorrespondenceSpan& correspondences,
                                              const RigidMotion& camera_from_body,
                                              const CorrespondenceLoss& loss) {
  return HWY_DYNAMIC_DISPATCH(accumulate_correspondences_lanes)(correspondences, camera_from_body,
                                                                loss);
}

void multiply_runs(const CorrespondenceSpan& correspondences, const RigidMotion& camera_from_body,
                   const CorrespondenceLoss& loss, std::span<const std::size_t> ends,
                   CorrespondenceProducts* products) {
  HWY_DYNAMIC_DISPATCH(multiply_runs_of)
  (correspondences, camera_from_body, loss, ends.data(), ends.size(), products);
}

double correspondence_cost(const CorrespondenceSpan& correspondences,
                           const RigidMotion& camera_from_body, const CorrespondenceLoss& loss) {
  return HWY_DYNAMIC_DISPATCH(correspondence_cost_lanes)(correspondences, camera_from_body, loss);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
