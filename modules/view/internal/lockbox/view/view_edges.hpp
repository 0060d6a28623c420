// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of a view lie at edges of the model: where bodies end, and where their depth bends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/rendering/depth_renderer.hpp"

namespace lockbox {

/// Reuses its buffers.
class ViewEdges {
 public:
  /// Finds edges among pixels that are drawn, or right beside; an edge at the border of the image
  /// is seen from within.
  void find(const RenderedDepth& view, const Executor& executor);

  /// The columns of a row's, from left to right.
  std::span<const std::int32_t> row(int v) const {
    const Row& row = rows_[static_cast<std::size_t>(v)];
    return {row.columns.data(), row.count};
  }

 private:
  struct Row {
    std::vector<std::int32_t> columns;  ///< the first `count` of them
    std::size_t count = 0;
  };

  static void find_in_row(const RenderedDepth& view, int v, Row& row);

  std::vector<Row> rows_;
};

}  // namespace lockbox
