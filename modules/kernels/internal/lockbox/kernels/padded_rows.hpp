// SPDX-License-Identifier: BSD-3-Clause
// A small matrix, row by row, of which vectors of any instruction set read whole rows.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// Each row begins at a cache line and ends with padding, which kernels may overwrite.
class PaddedRows {
 public:
  /// Makes all of them zero. Memory is kept.
  void resize(std::size_t rows, std::size_t columns) {
    rows_ = rows;
    columns_ = columns;
    lines_.assign(rows * stride() / kLanes, {});
  }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  /// Floats from one row to the next.
  std::size_t stride() const { return padded(columns_); }
  std::span<float> row(std::size_t i) { return {lines_[i * stride() / kLanes].data(), columns_}; }

 private:
  struct alignas(64) Line : std::array<float, kLanes> {};

  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<Line> lines_;
};

}  // namespace lockbox::kernels
