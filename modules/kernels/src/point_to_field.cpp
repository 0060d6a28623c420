// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/point_to_field.hpp"

#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "point_to_field.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// At most kLanes lanes, also where vectors are longer.
using FloatTag = hn::CappedTag<float, kLanes>;
using IntTag = hn::RebindToSigned<FloatTag>;
using Float = hn::Vec<FloatTag>;
using Int = hn::Vec<IntTag>;

/// A nearest surface whose outward normal makes less than this angle's cosine with the viewing ray
/// is the far side of the body: what the camera sees there cannot be it. Outlines (cosine near 0)
/// must stay, for points beyond them pull the body sideways.
constexpr float kFarSideCosine = 0.6F;

/// Position of points on the field's grids, chosen lane by lane between fine and coarse.
struct GridPosition {
  Int byte_offset;  // of the cell's first sample
  Int stride_y;     // bytes
  Int stride_z;
  Float fraction[3];
  Float scale;          // metres per unit
  Float inverse_voxel;  // 1 / metres
  hn::Mask<FloatTag> inside;
};

HWY_INLINE GridPosition locate(const FieldView& field, const Float p[3]) {
  const FloatTag df;
  const IntTag di;
  GridPosition at;
  const Int zero = hn::Zero(di);
  Int block[3];
  Int cell[3];
  Float g[3];
  auto fine = hn::Eq(zero, zero);
  for (int axis = 0; axis < 3; ++axis) {
    g[axis] = hn::Mul(hn::Sub(p[axis], hn::Set(df, field.fine_origin[axis])),
                      hn::Set(df, 1.0F / field.fine_voxel));
    const Float lowest = hn::Zero(df);
    const Float highest = hn::Set(df, static_cast<float>(field.blocks[axis] * kBlockCells) - 1e-3F);
    fine = hn::And(fine,
                   hn::RebindMask(di, hn::And(hn::Ge(g[axis], lowest), hn::Le(g[axis], highest))));
    // Clamped so that lanes off the grid still read inside the table.
    cell[axis] = hn::ConvertTo(di, hn::Min(hn::Max(g[axis], lowest), highest));
    block[axis] = hn::ShiftRight<3>(cell[axis]);
  }
  const Int block_index = hn::Add(
      block[0], hn::Mul(hn::Set(di, field.blocks[0]),
                        hn::Add(block[1], hn::Mul(hn::Set(di, field.blocks[1]), block[2]))));
  const Int first = hn::GatherIndex(di, field.block_first, block_index);
  fine = hn::And(fine, hn::Gt(first, hn::Set(di, -1)));

  const Int mask7 = hn::Set(di, kBlockCells - 1);
  const Int fine_offset =
      hn::Add(first, hn::Add(hn::And(cell[0], mask7),
                             hn::Add(hn::Mul(hn::And(cell[1], mask7), hn::Set(di, kBlockSamples)),
                                     hn::Mul(hn::And(cell[2], mask7),
                                             hn::Set(di, kBlockSamples * kBlockSamples)))));
  const auto fine_f = hn::RebindMask(df, fine);
  if (hn::AllTrue(di, fine)) {
    at.byte_offset = hn::ShiftLeft<1>(fine_offset);
    at.stride_y = hn::Set(di, 2 * kBlockSamples);
    at.stride_z = hn::Set(di, 2 * kBlockSamples * kBlockSamples);
    at.scale = hn::Set(df, field.fine_scale);
    at.inverse_voxel = hn::Set(df, 1.0F / field.fine_voxel);
    at.inside = fine_f;
    for (int axis = 0; axis < 3; ++axis) {
      at.fraction[axis] = hn::Sub(g[axis], hn::ConvertTo(df, cell[axis]));
    }
    return at;
  }

  auto inside = hn::Eq(zero, zero);
  Int coarse_offset = zero;
  std::int32_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const Float c = hn::Mul(hn::Sub(p[axis], hn::Set(df, field.coarse_origin[axis])),
                            hn::Set(df, 1.0F / field.coarse_voxel));
    const Float lowest = hn::Zero(df);
    const Float highest = hn::Set(df, static_cast<float>(field.coarse_size[axis] - 1) - 1e-3F);
    inside = hn::And(inside, hn::RebindMask(di, hn::And(hn::Ge(c, lowest), hn::Le(c, highest))));
    const Int coarse_cell = hn::ConvertTo(di, hn::Min(hn::Max(c, lowest), highest));
    coarse_offset = hn::Add(coarse_offset, hn::Mul(coarse_cell, hn::Set(di, stride)));
    stride *= field.coarse_size[axis];
    at.fraction[axis] = hn::IfThenElse(fine_f, hn::Sub(g[axis], hn::ConvertTo(df, cell[axis])),
                                       hn::Sub(c, hn::ConvertTo(df, coarse_cell)));
  }
  const std::int32_t row = field.coarse_size[0];
  at.byte_offset = hn::ShiftLeft<1>(hn::IfThenElse(fine, fine_offset, coarse_offset));
  at.stride_y = hn::IfThenElse(fine, hn::Set(di, 2 * kBlockSamples), hn::Set(di, 2 * row));
  at.stride_z = hn::IfThenElse(fine, hn::Set(di, 2 * kBlockSamples * kBlockSamples),
                               hn::Set(di, 2 * row * field.coarse_size[1]));
  at.scale = hn::IfThenElse(fine_f, hn::Set(df, field.fine_scale), hn::Set(df, field.coarse_scale));
  at.inverse_voxel = hn::IfThenElse(fine_f, hn::Set(df, 1.0F / field.fine_voxel),
                                    hn::Set(df, 1.0F / field.coarse_voxel));
  at.inside = hn::RebindMask(df, hn::Or(fine, inside));
  return at;
}

/// Two neighbours in x from one 32-bit load.
HWY_INLINE void load_pair(const FieldView& field, const Int byte_offset, Float& at0, Float& at1) {
  const FloatTag df;
  const IntTag di;
  const Int pair =
      hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(field.samples), byte_offset);
  at0 = hn::ConvertTo(df, hn::ShiftRight<16>(hn::ShiftLeft<16>(pair)));
  at1 = hn::ConvertTo(df, hn::ShiftRight<16>(pair));
}

HWY_INLINE Float lerp(const Float a, const Float b, const Float t) {
  return hn::MulAdd(t, hn::Sub(b, a), a);
}

/// Tri-linear value and, if wanted, its exact gradient.
template <bool WithGradient>
HWY_INLINE Float interpolate(const FieldView& field, const GridPosition& at, Float gradient[3]) {
  Float c000;
  Float c100;
  Float c010;
  Float c110;
  Float c001;
  Float c101;
  Float c011;
  Float c111;
  load_pair(field, at.byte_offset, c000, c100);
  load_pair(field, hn::Add(at.byte_offset, at.stride_y), c010, c110);
  const Int upper = hn::Add(at.byte_offset, at.stride_z);
  load_pair(field, upper, c001, c101);
  load_pair(field, hn::Add(upper, at.stride_y), c011, c111);

  const Float* t = at.fraction;
  const Float x00 = lerp(c000, c100, t[0]);
  const Float x10 = lerp(c010, c110, t[0]);
  const Float x01 = lerp(c001, c101, t[0]);
  const Float x11 = lerp(c011, c111, t[0]);
  const Float y0 = lerp(x00, x10, t[1]);
  const Float y1 = lerp(x01, x11, t[1]);
  if constexpr (WithGradient) {
    const Float unit = hn::Mul(at.scale, at.inverse_voxel);
    const Float dx0 = lerp(hn::Sub(c100, c000), hn::Sub(c110, c010), t[1]);
    const Float dx1 = lerp(hn::Sub(c101, c001), hn::Sub(c111, c011), t[1]);
    gradient[0] = hn::Mul(unit, lerp(dx0, dx1, t[2]));
    gradient[1] = hn::Mul(unit, lerp(hn::Sub(x10, x00), hn::Sub(x11, x01), t[2]));
    gradient[2] = hn::Mul(unit, hn::Sub(y1, y0));
  }
  return hn::Mul(at.scale, lerp(y0, y1, t[2]));
}

HWY_INLINE void transform(const RigidMotion& motion, const Float p[3], Float result[3]) {
  const FloatTag df;
  for (int row = 0; row < 3; ++row) {
    const float* r = motion.rotation + static_cast<std::ptrdiff_t>(3) * row;
    result[row] = hn::MulAdd(
        hn::Set(df, r[0]), p[0],
        hn::MulAdd(hn::Set(df, r[1]), p[1],
                   hn::MulAdd(hn::Set(df, r[2]), p[2], hn::Set(df, motion.translation[row]))));
  }
}

HWY_INLINE Float dot(const Float a[3], const Float b[3]) {
  return hn::MulAdd(a[0], b[0], hn::MulAdd(a[1], b[1], hn::Mul(a[2], b[2])));
}

void look_up_points(const FieldView& field, const RigidMotion& motion, const PointNoise& noise,
                    const PointSpan& points, const FieldHits& hits) {
  const FloatTag df;
  const Float zero = hn::Zero(df);
  const Float translation[3] = {hn::Set(df, motion.translation[0]),
                                hn::Set(df, motion.translation[1]),
                                hn::Set(df, motion.translation[2])};
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
    Float q[3];
    Float n[3];
    transform(motion, p, q);
    const GridPosition at = locate(field, q);
    const Float distance = interpolate<true>(field, at, n);

    const Float p2 = dot(p, p);
    const Float ray[3] = {hn::Sub(q[0], translation[0]), hn::Sub(q[1], translation[1]),
                          hn::Sub(q[2], translation[2])};
    const Float along = dot(n, ray);  // n . p, both in the body's axes
    const Float along2 = hn::Mul(along, along);
    const Float z2 = hn::Mul(p[2], p[2]);
    const Float sigma_z =
        hn::MulAdd(hn::Set(df, noise.depth_quadratic), z2, hn::Set(df, noise.depth_floor));
    const Float lateral2 = hn::Mul(hn::Set(df, noise.lateral * noise.lateral), z2);
    const Float across = hn::Max(zero, hn::Sub(dot(n, n), hn::Div(along2, p2)));
    const Float variance =
        hn::MulAdd(hn::Div(along2, z2), hn::Mul(sigma_z, sigma_z),
                   hn::MulAdd(across, lateral2, hn::Set(df, noise.spread * noise.spread + 1e-10F)));
    const auto far_side =
        hn::And(hn::Gt(along, zero),
                hn::Gt(along2, hn::Mul(hn::Set(df, kFarSideCosine * kFarSideCosine), p2)));
    const auto explains = hn::AndNot(far_side, at.inside);

    hn::StoreU(distance, df, hits.distance + i);
    for (int axis = 0; axis < 3; ++axis) {
      hn::StoreU(n[axis], df, hits.normal[axis] + i);
      hn::StoreU(q[axis], df, hits.position[axis] + i);
    }
    hn::StoreU(hn::IfThenElseZero(explains, hn::Div(hn::Set(df, 1.0F), variance)), df,
               hits.inverse_variance + i);
  }
}

void look_up_point_distances(const FieldView& field, const RigidMotion& motion,
                             const PointSpan& points, float* distance) {
  const FloatTag df;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
    Float q[3];
    transform(motion, p, q);
    const GridPosition at = locate(field, q);
    const Float d = interpolate<false>(field, at, nullptr);
    // Off the field: far beyond any cut.
    hn::StoreU(hn::IfThenElse(at.inside, d, hn::Set(df, kPadding)), df, distance + i);
  }
}

/// exp(-s / 2) with s = distance^2 / variance; 0 where the body explains nothing.
HWY_INLINE Float likelihood(const Float distance, const Float inverse_variance) {
  const FloatTag df;
  const Float half =
      hn::Mul(hn::Set(df, -0.5F), hn::Mul(hn::Mul(distance, distance), inverse_variance));
  const Float bounded = hn::Max(half, hn::Set(df, -80.0F));  // exp of less is no float
  return hn::IfThenElseZero(hn::Gt(inverse_variance, hn::Zero(df)), hn::Exp(df, bounded));
}

template <bool WithWeights>
double associate_points_with(const Candidates& candidates, std::span<float* const> weight,
                             float* explained) {
  const FloatTag df;
  const float outlier_cost = 0.5F * candidates.cut * candidates.cut;
  const Float c = hn::Set(df, outlier_cost);
  const Float outlier = hn::Set(df, std::exp(-outlier_cost));
  const Float one = hn::Set(df, 1.0F);
  const Float visible_odds = hn::Set(df, candidates.visible_odds);
  Float total = hn::Zero(df);
  for (std::size_t i = 0; i < candidates.size; i += hn::Lanes(df)) {
    const Float visible = hn::LoadU(df, candidates.visible + i);
    Float sum = outlier;
    for (std::size_t l = 0; l < candidates.distance.size(); ++l) {
      const Float odds =
          hn::IfThenElse(hn::Eq(visible, hn::Set(df, candidates.body[l])), visible_odds, one);
      const Float share =
          hn::Mul(odds, likelihood(hn::LoadU(df, candidates.distance[l] + i),
                                   hn::LoadU(df, candidates.inverse_variance[l] + i)));
      sum = hn::Add(sum, share);
      if constexpr (WithWeights) {
        hn::StoreU(share, df, weight[l] + i);
      }
    }
    const Float gain = hn::Add(hn::Log(df, sum), c);
    total = hn::Sub(total, gain);
    if constexpr (WithWeights) {
      const Float inverse_sum = hn::Div(one, sum);
      for (std::size_t l = 0; l < candidates.distance.size(); ++l) {
        const Float iv = hn::LoadU(df, candidates.inverse_variance[l] + i);
        const Float w = hn::Mul(hn::LoadU(df, weight[l] + i), hn::Mul(inverse_sum, iv));
        hn::StoreU(w, df, weight[l] + i);
      }
      hn::StoreU(gain, df, explained + i);
    }
  }
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(df, total)));
}

double associate_points(const Candidates& candidates, std::span<float* const> weight,
                        float* explained) {
  return associate_points_with<true>(candidates, weight, explained);
}

double total_association_cost(const Candidates& candidates) {
  return associate_points_with<false>(candidates, {}, nullptr);
}

NormalSums accumulate_points(std::size_t size, const FieldHits& hits, const float* weight) {
  const FloatTag df;
  Float hessian[21];
  Float gradient[6];
  for (Float& h : hessian) {
    h = hn::Zero(df);
  }
  for (Float& g : gradient) {
    g = hn::Zero(df);
  }
  Float squares = hn::Zero(df);
  Float count = hn::Zero(df);
  for (std::size_t i = 0; i < size; i += hn::Lanes(df)) {
    const Float w = hn::LoadU(df, weight + i);
    const Float d = hn::LoadU(df, hits.distance + i);
    Float p[3];
    Float a[6];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = hn::LoadU(df, hits.position[axis] + i);
      a[axis] = hn::LoadU(df, hits.normal[axis] + i);
    }
    a[3] = hn::MulSub(p[1], a[2], hn::Mul(p[2], a[1]));
    a[4] = hn::MulSub(p[2], a[0], hn::Mul(p[0], a[2]));
    a[5] = hn::MulSub(p[0], a[1], hn::Mul(p[1], a[0]));
    const Float wd = hn::IfThenElseZero(hn::Gt(w, hn::Zero(df)), hn::Mul(w, d));
    int k = 0;
    for (int row = 0; row < 6; ++row) {
      const Float wa = hn::Mul(w, a[row]);
      for (int column = row; column < 6; ++column) {
        hessian[k] = hn::MulAdd(wa, a[column], hessian[k]);
        ++k;
      }
      gradient[row] = hn::NegMulAdd(wd, a[row], gradient[row]);
    }
    squares = hn::MulAdd(wd, d, squares);
    const Float iv = hn::LoadU(df, hits.inverse_variance + i);
    count = hn::Add(count, hn::IfThenElseZero(hn::Gt(iv, hn::Zero(df)), hn::Div(w, iv)));
  }
  NormalSums sums{};
  for (int k = 0; k < 21; ++k) {
    sums.hessian[k] = static_cast<double>(hn::GetLane(hn::SumOfLanes(df, hessian[k])));
  }
  for (int k = 0; k < 6; ++k) {
    sums.gradient[k] = static_cast<double>(hn::GetLane(hn::SumOfLanes(df, gradient[k])));
  }
  sums.weighted_squares = static_cast<double>(hn::GetLane(hn::SumOfLanes(df, squares)));
  sums.weight = static_cast<double>(hn::GetLane(hn::SumOfLanes(df, count)));
  return sums;
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(look_up_points);
HWY_EXPORT(look_up_point_distances);
HWY_EXPORT(associate_points);
HWY_EXPORT(total_association_cost);
HWY_EXPORT(accumulate_points);

void look_up(const FieldView& field, const RigidMotion& body_from_camera, const PointNoise& noise,
             const PointSpan& points, const FieldHits& hits) {
  HWY_DYNAMIC_DISPATCH(look_up_points)(field, body_from_camera, noise, points, hits);
}

void look_up_distance(const FieldView& field, const RigidMotion& body_from_camera,
                      const PointSpan& points, float* distance) {
  HWY_DYNAMIC_DISPATCH(look_up_point_distances)(field, body_from_camera, points, distance);
}

double associate(const Candidates& candidates, std::span<float* const> weight, float* explained) {
  return HWY_DYNAMIC_DISPATCH(associate_points)(candidates, weight, explained);
}

double association_cost(const Candidates& candidates) {
  return HWY_DYNAMIC_DISPATCH(total_association_cost)(candidates);
}

NormalSums accumulate(std::size_t size, const FieldHits& hits, const float* weight) {
  return HWY_DYNAMIC_DISPATCH(accumulate_points)(size, hits, weight);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
