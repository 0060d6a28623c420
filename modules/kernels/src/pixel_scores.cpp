// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/pixel_scores.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pixel_scores.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "columns-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

/// What a pixel loses with the square of its deviation in standard deviations: three cost two.
/// Source: not recorded. Doubled, two deviations cost as much as three do.
constexpr float kFallOff = 0.22F;
/// Tangent of the incidence beyond which surfaces count alike: of 79 degrees. Source: not recorded.
/// Doubled, what is seen at a graze may be twice as far off.
constexpr float kSteepest = 5.0F;
/// Standard deviations. Source: of normal errors one in 370 is beyond it. Doubled, pixels of an
/// edge are free-space violations only where the gap behind is twice as deep.
constexpr float kDoubt = 3.0F;

/// Of what is drawn at a pixel and one beside it, of the same body; infinite where it is another.
template <typename D>
HWY_INLINE hn::Vec<D> change_of_depth(const D df, const hn::Vec<D> here,
                                      const hn::VFromD<hn::Rebind<std::int16_t, D>> label,
                                      const float* depth, const std::int16_t* labels) {
  const hn::Rebind<std::int16_t, D> ds;
  const hn::RebindToSigned<D> di;
  const auto other = hn::PromoteTo(di, hn::Xor(label, hn::LoadU(ds, labels)));
  const auto is_same = hn::RebindMask(df, hn::Eq(other, hn::Zero(di)));
  return hn::IfThenElse(is_same, hn::AbsDiff(hn::LoadU(df, depth), here), hn::Inf(df));
}

/// The smaller one to two opposite neighbours; none where both show something else.
template <typename D>
HWY_INLINE hn::Vec<D> smaller_change(const D df, const hn::Vec<D> one, const hn::Vec<D> other) {
  const auto least = hn::Min(one, other);
  return hn::IfThenElseZero(hn::Lt(least, hn::Inf(df)), least);
}

void score_pixels_of_row(const DepthRows& depths, const LabelRows& labels,
                         const MeasuredRow& measured, std::size_t first, std::size_t end,
                         const PixelScoring& scoring, float* scores) {
  for_columns(first, end, [&](auto df, std::size_t u) HWY_ATTR {
    const hn::Rebind<std::int16_t, decltype(df)> ds;
    const hn::RebindToSigned<decltype(df)> di;
    const auto z = hn::LoadU(df, depths.here + u);
    const auto m = hn::LoadU(df, measured.depth + u);
    const auto label = hn::LoadU(ds, labels.here + u);
    const auto change = [&](const float* depth, const std::int16_t* labels_there) HWY_ATTR {
      return change_of_depth(df, z, label, depth + u, labels_there + u);
    };
    const auto along_row = smaller_change(df, change(depths.here - 1, labels.here - 1),
                                          change(depths.here + 1, labels.here + 1));
    const auto along_column =
        smaller_change(df, change(depths.above, labels.above), change(depths.below, labels.below));
    const auto per_pixel2 = hn::MulAdd(along_row, along_row, hn::Mul(along_column, along_column));

    const auto slack = hn::Set(df, scoring.slack);
    const auto noise = hn::Set(df, scoring.noise);
    const auto per_metre = hn::Div(hn::Set(df, scoring.pixels_per_metre), z);
    const auto steepness2 = hn::Min(hn::Mul(per_pixel2, hn::Mul(per_metre, per_metre)),
                                    hn::Set(df, kSteepest * kSteepest));
    const auto sigma = hn::Mul(noise, hn::Mul(z, z));
    const auto slack2 = hn::Mul(slack, slack);
    const auto variance = hn::MulAdd(
        sigma, sigma,
        hn::MulAdd(slack2, steepness2, hn::MulAdd(hn::Set(df, 0.25F), per_pixel2, slack2)));

    const auto difference = hn::Sub(m, z);
    const auto cost = hn::Div(hn::Mul(difference, difference), variance);
    const auto score = hn::NegMulAdd(hn::Set(df, kFallOff), cost, hn::Set(df, 1.0F));
    // Where a neighbour is near enough, it is a matter of a pixel more or less.
    const auto is_beside = hn::Lt(hn::Sub(hn::LoadU(df, measured.nearest + u), z),
                                  hn::Mul(hn::Set(df, kDoubt), hn::Sqrt(variance)));
    const auto violating = hn::IfThenZeroElse(is_beside, hn::Set(df, scoring.violating));
    const auto is_before = hn::Lt(difference, hn::Zero(df));
    const auto least = hn::IfThenElse(is_before, hn::Set(df, scoring.occluded), violating);

    const auto doubt = hn::Mul(hn::Set(df, kDoubt), hn::Mul(noise, hn::Mul(m, m)));
    const auto is_in_reach = hn::Ge(hn::Add(m, doubt), hn::Set(df, scoring.reach));
    const auto is_drawn = hn::RebindMask(df, hn::Gt(hn::PromoteTo(di, label), hn::Set(di, -1)));
    const auto tells = hn::And(hn::And(is_drawn, is_in_reach), hn::Gt(m, hn::Zero(df)));
    hn::StoreU(hn::IfThenElseZero(tells, hn::Max(score, least)), df, scores + (u - first));
  });
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(score_pixels_of_row);

void score_pixels(const DepthRows& depths, const LabelRows& labels, const MeasuredRow& measured,
                  std::size_t first, std::size_t end, const PixelScoring& scoring, float* scores) {
  HWY_DYNAMIC_DISPATCH(score_pixels_of_row)
  (depths, labels, measured, first, end, scoring, scores);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
