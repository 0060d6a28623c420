// SPDX-License-Identifier: BSD-3-Clause
// Tri-linear look-up in a field, lane by lane. To be included within Highway's foreach_target:
// once for each instruction set.
#if defined(LOCKBOX_KERNELS_FIELD_LOOK_UP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_FIELD_LOOK_UP_INL
#undef LOCKBOX_KERNELS_FIELD_LOOK_UP_INL
#else
#define LOCKBOX_KERNELS_FIELD_LOOK_UP_INL
#endif

#include "hwy/cache_control.h"
#include "lockbox/kernels/point_to_field.hpp"
#include "vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

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

/// The fine cells that points are in, if their blocks are stored.
struct FineCells {
  Float g[3];                   // grid coordinates
  Int cell[3];                  // clamped to the grid
  Int offset;                   // of the cell's first corner, samples
  hn::Mask<IntTag> are_stored;  // by lane
};

HWY_INLINE FineCells find_fine_cells(const FieldView& field, const Float p[3]) {
  const FloatTag df;
  const IntTag di;
  FineCells at;
  const Int zero = hn::Zero(di);
  Int block[3];
  at.are_stored = hn::Eq(zero, zero);
  for (int axis = 0; axis < 3; ++axis) {
    at.g[axis] = hn::Mul(hn::Sub(p[axis], hn::Set(df, field.fine_origin[axis])),
                         hn::Set(df, 1.0F / field.fine_voxel));
    const Float lowest = hn::Zero(df);
    const Float highest = hn::Set(df, static_cast<float>(field.blocks[axis] * kBlockCells) - 1e-3F);
    at.are_stored = hn::And(
        at.are_stored,
        hn::RebindMask(di, hn::And(hn::Ge(at.g[axis], lowest), hn::Le(at.g[axis], highest))));
    // Clamped so that lanes off the grid still read inside the table.
    at.cell[axis] = hn::ConvertTo(di, hn::Min(hn::Max(at.g[axis], lowest), highest));
    block[axis] = hn::ShiftRight<3>(at.cell[axis]);
  }
  const Int block_index = hn::Add(
      block[0], hn::Mul(hn::Set(di, field.blocks[0]),
                        hn::Add(block[1], hn::Mul(hn::Set(di, field.blocks[1]), block[2]))));
  const Int first = hn::GatherIndex(di, field.block_first, block_index);
  at.are_stored = hn::And(at.are_stored, hn::Gt(first, hn::Set(di, -1)));
  const Int mask7 = hn::Set(di, kBlockCells - 1);
  at.offset = hn::Add(
      first, hn::Add(hn::And(at.cell[0], mask7),
                     hn::Add(hn::Mul(hn::And(at.cell[1], mask7), hn::Set(di, kBlockSamples)),
                             hn::Mul(hn::And(at.cell[2], mask7),
                                     hn::Set(di, kBlockSamples * kBlockSamples)))));
  return at;
}

HWY_INLINE GridPosition locate(const FieldView& field, const Float p[3]) {
  const FloatTag df;
  const IntTag di;
  GridPosition at;
  const FineCells fine = find_fine_cells(field, p);
  const auto is_fine = hn::RebindMask(df, fine.are_stored);
  if (hn::AllTrue(di, fine.are_stored)) {
    at.byte_offset = hn::ShiftLeft<1>(fine.offset);
    at.stride_y = hn::Set(di, 2 * kBlockSamples);
    at.stride_z = hn::Set(di, 2 * kBlockSamples * kBlockSamples);
    at.scale = hn::Set(df, field.fine_scale);
    at.inverse_voxel = hn::Set(df, 1.0F / field.fine_voxel);
    at.inside = is_fine;
    for (int axis = 0; axis < 3; ++axis) {
      at.fraction[axis] = hn::Sub(fine.g[axis], hn::ConvertTo(df, fine.cell[axis]));
    }
    return at;
  }

  Int coarse_offset = hn::Zero(di);
  auto inside = hn::Eq(coarse_offset, coarse_offset);
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
    at.fraction[axis] =
        hn::IfThenElse(is_fine, hn::Sub(fine.g[axis], hn::ConvertTo(df, fine.cell[axis])),
                       hn::Sub(c, hn::ConvertTo(df, coarse_cell)));
  }
  const std::int32_t row = field.coarse_size[0];
  at.byte_offset = hn::ShiftLeft<1>(hn::IfThenElse(fine.are_stored, fine.offset, coarse_offset));
  at.stride_y =
      hn::IfThenElse(fine.are_stored, hn::Set(di, 2 * kBlockSamples), hn::Set(di, 2 * row));
  at.stride_z = hn::IfThenElse(fine.are_stored, hn::Set(di, 2 * kBlockSamples * kBlockSamples),
                               hn::Set(di, 2 * row * field.coarse_size[1]));
  at.scale =
      hn::IfThenElse(is_fine, hn::Set(df, field.fine_scale), hn::Set(df, field.coarse_scale));
  at.inverse_voxel = hn::IfThenElse(is_fine, hn::Set(df, 1.0F / field.fine_voxel),
                                    hn::Set(df, 1.0F / field.coarse_voxel));
  at.inside = hn::RebindMask(df, hn::Or(fine.are_stored, inside));
  return at;
}

/// Asks for the samples of the lanes' cells.
HWY_INLINE void prefetch(const FieldView& field, const GridPosition& at) {
  const IntTag di;
  HWY_ALIGN std::int32_t lower[kLanes];
  HWY_ALIGN std::int32_t upper[kLanes];
  hn::Store(at.byte_offset, di, lower);
  hn::Store(hn::Add(at.byte_offset, at.stride_z), di, upper);
  const auto* const samples = reinterpret_cast<const char*>(field.samples);
  for (std::size_t lane = 0; lane < hn::Lanes(di); ++lane) {
    hwy::Prefetch(samples + lower[lane]);
    hwy::Prefetch(samples + upper[lane]);
  }
}

/// Calls place(i, p), which writes where the points of lanes i .. are (body frame), then
/// visit(i, p, at). A few vectors are located before the first of them is visited: points are far
/// apart, and each look-up would wait for its samples.
template <typename Place, typename Visit>
HWY_INLINE void for_located(const FieldView& field, const std::size_t size, const Place& place,
                            const Visit& visit) {
  constexpr std::size_t kTogether = 8;
  const std::size_t lanes = hn::Lanes(FloatTag());
  Float p[kTogether][3];
  GridPosition at[kTogether];
  for (std::size_t first = 0; first < size; first += kTogether * lanes) {
    const std::size_t vectors = HWY_MIN(kTogether, (size - first + lanes - 1) / lanes);
    for (std::size_t k = 0; k < vectors; ++k) {
      place(first + k * lanes, p[k]);
      at[k] = locate(field, p[k]);
      prefetch(field, at[k]);
    }
    for (std::size_t k = 0; k < vectors; ++k) visit(first + k * lanes, p[k], at[k]);
  }
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

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
