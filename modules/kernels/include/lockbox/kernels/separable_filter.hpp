// SPDX-License-Identifier: BSD-3-Clause
// An image filtered along its rows, then along its columns, by the same symmetric taps.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <span>

namespace lockbox::kernels {

/// Columns are computed in blocks of so many.
inline constexpr std::size_t kFilterBlock = 16;

/// Rows of next_row numbers: reach of padding, `columns` of the image, and at least as many again
/// as fill the last block and the padding. Likewise reach rows above and below.
struct PaddedLayout {
  std::size_t columns;
  std::size_t rows;
  std::size_t reach;

  std::size_t filled_columns() const {
    return (columns + kFilterBlock - 1) / kFilterBlock * kFilterBlock;
  }
  std::size_t next_row() const { return filled_columns() + 2 * reach; }
  std::size_t size() const { return next_row() * (rows + 2 * reach); }
  /// Where a row of the image begins.
  std::size_t row(std::size_t v) const { return (v + reach) * next_row() + reach; }
};

/// taps: from the centre on, reach + 1. The padding of the image and of `along_rows`, above and
/// below, must be zero. filtered: the same layout; beside the image it holds anything afterwards.
void filter_separably(const PaddedLayout& layout, std::span<const float> taps, const float* image,
                      float* along_rows, float* filtered);

}  // namespace lockbox::kernels
