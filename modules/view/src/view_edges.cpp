// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/view_edges.hpp"

#include <algorithm>

#include "lockbox/kernels/contours.hpp"

namespace lockbox {
namespace {

constexpr float kLeastStep = 1.5e-3F;         // of the depth: a bend or a step within a body
constexpr std::size_t kEdgeRowsPerChunk = 8;  // that a thread takes at once

}  // namespace

void ViewEdges::find(const RenderedDepth& view, const Executor& executor) {
  const auto height = static_cast<std::size_t>(view.height);
  if (rows_.size() < height) rows_.resize(height);
  executor.for_each_chunk(height, kEdgeRowsPerChunk, [&](std::size_t begin, std::size_t end, auto) {
    for (std::size_t v = begin; v < end; ++v) find_in_row(view, static_cast<int>(v), rows_[v]);
  });
}

void ViewEdges::find_in_row(const RenderedDepth& view, int v, Row& row) {
  row.count = 0;
  const ImageWindow& drawn = view.drawn;
  const int first = std::max(drawn.left - 1, 1);
  const int end = std::min(drawn.right() + 1, view.width - 1);
  if (v < drawn.top - 1 || v > drawn.bottom() || drawn.width == 0 || first >= end) return;
  row.columns.resize(static_cast<std::size_t>(view.width) + kernels::kLanes);
  const std::size_t above = view.index(0, std::max(v - 1, 0));
  const std::size_t here = view.index(0, v);
  const std::size_t below = view.index(0, std::min(v + 1, view.height - 1));
  const float* z = view.depth.data();
  const std::int16_t* label = view.id.data();
  row.count = kernels::find_edges({z + above, z + here, z + below},
                                  {label + above, label + here, label + below},
                                  static_cast<std::size_t>(first), static_cast<std::size_t>(end),
                                  kLeastStep, row.columns.data());
}

}  // namespace lockbox
