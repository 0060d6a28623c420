// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/window_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "window_sums.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using NumberTag = hn::CappedTag<std::int16_t, kWindowBlock>;
using Number = hn::Vec<NumberTag>;

/// Some rows of as many columns as a vector has lanes, kept in registers.
template <std::size_t Rows>
HWY_INLINE void add_strip(const Windows& windows, const std::size_t row, const std::size_t column,
                          std::int16_t* const sums) {
  const NumberTag tag;
  Number sum[Rows];
  for (std::size_t i = 0; i < Rows; ++i) sum[i] = hn::Zero(tag);
  for (const std::int16_t* const first : windows.first) {
    const std::int16_t* const from = first + row * windows.next_row + column;
    for (std::size_t i = 0; i < Rows; ++i) {
      sum[i] = hn::Add(sum[i], hn::LoadU(tag, from + i * windows.next_row));
    }
  }
  for (std::size_t i = 0; i < Rows; ++i) {
    hn::StoreU(sum[i], tag, sums + (row + i) * windows.columns + column);
  }
}

void add_all_windows(const Windows& windows, std::int16_t* const sums) {
  constexpr std::size_t kRowsAtOnce = 8;
  const NumberTag tag;
  for (std::size_t column = 0; column < windows.columns; column += hn::Lanes(tag)) {
    std::size_t row = 0;
    for (; row + kRowsAtOnce <= windows.rows; row += kRowsAtOnce) {
      add_strip<kRowsAtOnce>(windows, row, column, sums);
    }
    for (; row < windows.rows; ++row) add_strip<1>(windows, row, column, sums);
  }
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(add_all_windows);

void add_windows(const Windows& windows, std::int16_t* sums) {
  HWY_DYNAMIC_DISPATCH(add_all_windows)(windows, sums);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
