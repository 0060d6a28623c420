// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/contours.hpp"

#include <array>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contours.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "columns-inl.hpp"
#include "label_rows-inl.hpp"
#include "plane_rows-inl.hpp"
#include "vote_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
/// Calls find(tag, column), which returns the lanes that are wanted, for all columns in
/// [first, end): many at once, and one by one what is left.
template <typename Find>
HWY_INLINE std::size_t collect(std::size_t first, std::size_t end, const Find& find,
                               std::int32_t* columns) {
  std::size_t count = 0;
  const auto collect_with = [&](auto df, std::size_t u) {
    const hn::RebindToSigned<decltype(df)> di;
    const auto wanted = find(df, u);
    if (hn::AllFalse(df, wanted)) return;  // mostly
    count += hn::CompressStore(hn::Iota(di, static_cast<std::int32_t>(u)),
                               hn::RebindMask(di, wanted), di, columns + count);
  };
  for_columns(first, end, collect_with);
  return count;
}

/// Of the pixels and their neighbours in row and column.
template <typename D>
HWY_INLINE hn::Vec<D> farthest(const D df, const DepthRows& depths, const std::size_t u) {
  const auto in_row =
      hn::Max(hn::LoadU(df, depths.here + u - 1), hn::LoadU(df, depths.here + u + 1));
  const auto in_column = hn::Max(hn::LoadU(df, depths.above + u), hn::LoadU(df, depths.below + u));
  return hn::Max(hn::LoadU(df, depths.here + u), hn::Max(in_row, in_column));
}

std::size_t find_bends_in_row(const DepthRows& depths, std::size_t first, std::size_t end,
                              float bend, std::int32_t* columns) {
  const auto bends = [&](auto df, std::size_t u) HWY_ATTR {
    const auto show_something =
        hn::Lt(farthest(df, depths, u), hn::Set(df, std::numeric_limits<float>::infinity()));
    return hn::AndNot(is_plane(df, depths, u, bend), show_something);
  };
  return collect(first, end, bends, columns);
}

std::size_t find_edges_in_row(const DepthRows& depths, const LabelRows& labels, std::size_t first,
                              std::size_t end, float least_step, std::int32_t* columns) {
  const auto edges = [&](auto df, std::size_t u) HWY_ATTR {
    const auto z = hn::LoadU(df, depths.here + u);
    const auto has_step = [&](const float* before, const float* after) HWY_ATTR {
      const auto bend =
          hn::NegMulAdd(hn::Set(df, 2.0F), z, hn::Add(hn::LoadU(df, before), hn::LoadU(df, after)));
      return hn::Gt(hn::Abs(bend), hn::Mul(hn::Set(df, least_step), z));
    };
    const auto bends = hn::Or(has_step(depths.here + u - 1, depths.here + u + 1),
                              has_step(depths.above + u, depths.below + u));
    return hn::Or(bends, shows_others_beside(df, labels, u));
  };
  return collect(first, end, edges, columns);
}

NormalVote vote_of(const float* corner, std::ptrdiff_t stride, const PixelPlane& plane,
                   float step) {
  const hn::CappedTag<float, kVoteColumns> df;
  const hn::RebindToSigned<decltype(df)> di;
  constexpr float kHorizon = 0.1F;  // of the relative nearness: the plane is seen edge on beyond it
  auto sum_u = hn::Zero(di);
  auto sum_v = hn::Zero(di);
  for (std::size_t row = 0; row < kVoteRows; ++row) {
    const float* depths = corner + static_cast<std::ptrdiff_t>(row) * stride;
    const float dv = static_cast<float>(row) - static_cast<float>(kVoteReach);
    for (std::size_t column = 0; column < kVoteColumns; column += hn::Lanes(df)) {
      const auto du = hn::Iota(df, static_cast<float>(column) - static_cast<float>(kVoteReach));
      // there > depth (1 / nearness + step), without a division
      const auto nearness = hn::Max(
          hn::Set(df, kHorizon),
          hn::MulAdd(hn::Set(df, plane.slope_u), du, hn::Set(df, 1.0F + plane.slope_v * dv)));
      const auto there = hn::Mul(hn::LoadU(df, depths + column), nearness);
      const auto here =
          hn::MulAdd(hn::Set(df, plane.depth * step), nearness, hn::Set(df, plane.depth));
      const auto is_beyond = hn::RebindMask(di, hn::Gt(there, here));
      sum_u = hn::Add(
          sum_u, hn::IfThenElseZero(is_beyond, hn::LoadU(di, kVoteTable.u[row].data() + column)));
      sum_v = hn::Add(
          sum_v, hn::IfThenElseZero(is_beyond, hn::LoadU(di, kVoteTable.v[row].data() + column)));
    }
  }
  return {hn::GetLane(hn::SumOfLanes(di, sum_u)), hn::GetLane(hn::SumOfLanes(di, sum_v))};
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(find_bends_in_row);
HWY_EXPORT(find_edges_in_row);
HWY_EXPORT(vote_of);

std::size_t find_bends(const DepthRows& depths, std::size_t first, std::size_t end, float bend,
                       std::int32_t* columns) {
  return HWY_DYNAMIC_DISPATCH(find_bends_in_row)(depths, first, end, bend, columns);
}

std::size_t find_edges(const DepthRows& depths, const LabelRows& labels, std::size_t first,
                       std::size_t end, float least_step, std::int32_t* columns) {
  return HWY_DYNAMIC_DISPATCH(find_edges_in_row)(depths, labels, first, end, least_step, columns);
}

NormalVote normal_vote(const float* corner, std::ptrdiff_t stride, const PixelPlane& plane,
                       float step) {
  return HWY_DYNAMIC_DISPATCH(vote_of)(corner, stride, plane, step);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
