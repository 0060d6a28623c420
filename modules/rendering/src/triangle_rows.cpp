// SPDX-License-Identifier: BSD-3-Clause
// SIMD twice: the spans of a triangle's rows are computed side by side, in double precision, then
// each is drawn. Most triangles of a fine mesh are a few pixels wide, so that rows cost more than
// pixels do.
#include "triangle_rows.hpp"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangle_rows.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::rendering::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Rows = hn::CappedTag<double, kBandRows>;
using RowIndices = hn::Rebind<std::int32_t, Rows>;
using RowValues = hn::Rebind<float, Rows>;
using Vector = hn::Vec<Rows>;

/// Of the pixels [left, right) of a row, the first one's 1/z.
struct Spans {
  HWY_ALIGN std::int32_t left[kBandRows];
  HWY_ALIGN std::int32_t right[kBandRows];
  HWY_ALIGN float inverse_z[kBandRows];
};

/// Returns the column by MulAdd, which no compiler contracts anew in each place: neighbours get the
/// same column.
HWY_INLINE Vector column_of(const Edge& edge, const Vector row) {
  const Rows tag;
  return hn::MulAdd(hn::Sub(row, hn::Set(tag, edge.v)), hn::Set(tag, edge.slope),
                    hn::Set(tag, edge.u));
}

/// The first column from `begin` on, and no more than `end`, whose centre is not before x; see
/// first_centre().
HWY_INLINE Vector first_centre_of(const Vector x, const Vector begin, const Vector end) {
  return hn::Ceil(hn::IfThenElse(hn::Gt(x, begin), hn::Min(x, end), begin));
}

HWY_INLINE void find_spans(const ScreenTriangle& t, const int first, const int count,
                           const ImageWindow& window, Spans& spans) {
  const Rows tag;
  const auto begin = hn::Set(tag, static_cast<double>(window.left));
  const auto end = hn::Set(tag, static_cast<double>(window.left + window.width));
  const auto middle = hn::Set(tag, static_cast<double>(t.middle_row));
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(tag))) {
    const auto row = hn::Iota(tag, static_cast<double>(first + i));
    const auto whole = column_of(t.whole, row);
    const auto broken =
        hn::IfThenElse(hn::Lt(row, middle), column_of(t.upper, row), column_of(t.lower, row));
    const auto left = first_centre_of(t.whole_is_left ? whole : broken, begin, end);
    const auto right = first_centre_of(t.whole_is_left ? broken : whole, begin, end);
    const auto along_row = hn::MulAdd(hn::Sub(left, hn::Set(tag, t.u0)), hn::Set(tag, t.du),
                                      hn::Set(tag, t.inverse_z));
    const auto inverse_z =
        hn::MulAdd(hn::Sub(row, hn::Set(tag, t.v0)), hn::Set(tag, t.dv), along_row);
    hn::Store(hn::DemoteTo(RowIndices(), left), RowIndices(), spans.left + i);
    hn::Store(hn::DemoteTo(RowIndices(), right), RowIndices(), spans.right + i);
    hn::Store(hn::DemoteTo(RowValues(), inverse_z), RowValues(), spans.inverse_z + i);
  }
}

/// Draws Lanes(tag) pixels, `offset` after the first of their span.
template <class Tag>
HWY_INLINE void draw_pixels(const Tag tag, const ScreenTriangle& t, const float start,
                            const std::size_t offset, float* const inverse_z,
                            std::int16_t* const ids) {
  const hn::Rebind<std::int16_t, Tag> id_tag;
  const auto step = hn::Set(tag, static_cast<float>(t.du));
  const auto plane =
      hn::MulAdd(hn::Iota(tag, static_cast<float>(offset)), step, hn::Set(tag, start));
  const auto candidate = hn::Min(hn::Max(plane, hn::Set(tag, t.low)), hn::Set(tag, t.high));
  const auto nearest = hn::LoadU(tag, inverse_z + offset);
  const auto is_nearer = hn::VecFromMask(tag, hn::Gt(candidate, nearest));
  const auto replaces_id = hn::DemoteTo(id_tag, hn::BitCast(hn::RebindToSigned<Tag>(), is_nearer));
  const auto id =
      hn::IfVecThenElse(replaces_id, hn::Set(id_tag, t.id), hn::LoadU(id_tag, ids + offset));
  hn::StoreU(hn::Max(nearest, candidate), tag, inverse_z + offset);
  hn::StoreU(id, id_tag, ids + offset);
}

/// From `offset` on; what fills no vector is drawn with shorter vectors. Not together with pixels
/// before it, a second time: loads that overlap what was stored just before made a Zen 4 core stand
/// still for 4.6 ms (2^24 cycles), in one of fifteen images.
template <class Tag>
HWY_INLINE void draw_span(const Tag tag, const ScreenTriangle& t, const float start,
                          std::size_t offset, const std::size_t count, float* const inverse_z,
                          std::int16_t* const ids) {
  const std::size_t lanes = hn::Lanes(tag);
  for (; offset + lanes <= count; offset += lanes) {
    draw_pixels(tag, t, start, offset, inverse_z, ids);
  }
  if constexpr (hn::MaxLanes(tag) > 1) {
    if (offset == count) return;
    constexpr std::size_t kHalf = hn::MaxLanes(tag) / 2;
    draw_span(hn::CappedTag<float, kHalf>(), t, start, offset, count, inverse_z, ids);
  }
}

void draw_rows_of(const ScreenTriangle& t, const int first_row, const int end_row,
                  const Canvas& canvas) {
  const int first = std::max(first_row, t.first_row);
  const int count = std::min(end_row, t.end_row) - first;
  Spans spans;
  find_spans(t, first, count, canvas.window, spans);
  for (int i = 0; i < count; ++i) {
    const int pixels = spans.right[i] - spans.left[i];
    if (pixels > 0) {
      const std::size_t at = canvas.index(spans.left[i], first + i);
      draw_span(hn::CappedTag<float, 16>(), t, spans.inverse_z[i], 0,
                static_cast<std::size_t>(pixels), canvas.inverse_z + at, canvas.ids + at);
    }
  }
}

}  // namespace lockbox::rendering::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::rendering {

HWY_EXPORT(draw_rows_of);

void draw_rows(const ScreenTriangle& triangle, int first_row, int end_row, const Canvas& canvas) {
  HWY_DYNAMIC_DISPATCH(draw_rows_of)(triangle, first_row, end_row, canvas);
}

}  // namespace lockbox::rendering
#endif  // HWY_ONCE
