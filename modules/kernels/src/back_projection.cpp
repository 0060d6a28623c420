// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/back_projection.hpp"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "back_projection.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kLanes>;
using PixelTag = hn::RebindToUnsigned<FloatTag>;
using Float = hn::Vec<FloatTag>;

constexpr float kLargest = std::numeric_limits<float>::max();

struct Extent {
  Float min;
  Float max;

  HWY_INLINE void extend(const hn::Mask<FloatTag> known, const Float value) {
    const FloatTag df;
    min = hn::Min(min, hn::IfThenElse(known, value, hn::Set(df, kLargest)));
    max = hn::Max(max, hn::IfThenElse(known, value, hn::Set(df, -kLargest)));
  }
};

/// The known ones among the lanes, one after the other. Whole vectors are stored as long as there
/// is room: compressing into memory is slow on some machines.
template <class Tag>
HWY_INLINE void store_known(const Tag tag, const hn::Vec<Tag> lanes, const hn::Mask<Tag> known,
                            const bool all_known, const bool has_room, hn::TFromD<Tag>* result) {
  if (all_known) {
    hn::StoreU(lanes, tag, result);
  } else if (has_room) {
    hn::StoreU(hn::Compress(lanes, known), tag, result);
  } else {
    hn::CompressBlendedStore(lanes, known, tag, result);
  }
}

std::size_t back_project_tile(const DepthTile& tile, const PointSlots& slots, PointBounds& bounds) {
  const FloatTag df;
  const PixelTag du;
  const Extent none{hn::Set(df, kLargest), hn::Set(df, -kLargest)};
  Extent extent[3] = {none, none, none};
  std::size_t count = 0;
  HWY_ALIGN float row_of_depth[kMostTileColumns] = {};  // 0 beyond the last column
  for (std::size_t row = 0; row < tile.rows; ++row) {
    const float* const depth = tile.depth + row * tile.next_row;
    std::copy_n(depth, tile.columns, row_of_depth);
    const auto first_pixel = tile.pixel + static_cast<std::uint32_t>(row) * tile.next_row;
    for (std::size_t column = 0; column < tile.columns; column += hn::Lanes(df)) {
      const Float z = hn::Load(df, row_of_depth + column);
      const auto known = hn::Gt(z, hn::Zero(df));
      const Float p[3] = {hn::Mul(hn::LoadU(df, tile.ray_x + column), z),
                          hn::Mul(hn::Set(df, tile.ray_y[row]), z), z};
      const bool all_known = hn::AllTrue(df, known);
      const bool has_room = count + hn::Lanes(df) <= tile.columns * tile.rows;
      float* const axes[3] = {slots.x + count, slots.y + count, slots.z + count};
      for (int axis = 0; axis < 3; ++axis) {
        extent[axis].extend(known, p[axis]);
        store_known(df, p[axis], known, all_known, has_room, axes[axis]);
      }
      store_known(du, hn::Iota(du, first_pixel + static_cast<std::uint32_t>(column)),
                  hn::RebindMask(du, known), all_known, has_room, slots.pixel + count);
      count += hn::CountTrue(df, known);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    bounds.min[axis] = hn::GetLane(hn::MinOfLanes(df, extent[axis].min));
    bounds.max[axis] = hn::GetLane(hn::MaxOfLanes(df, extent[axis].max));
  }
  return count;
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(back_project_tile);

std::size_t back_project(const DepthTile& tile, const PointSlots& slots, PointBounds& bounds) {
  return HWY_DYNAMIC_DISPATCH(back_project_tile)(tile, slots, bounds);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
