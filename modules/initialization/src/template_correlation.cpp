// SPDX-License-Identifier: BSD-3-Clause
#include "template_correlation.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/kernels/window_sums.hpp"

namespace lockbox {
namespace {

// Of one cell. The sums over the few thousand cells of a template stay within 16 bits.
constexpr float kInRange = 2.0F;          // where joints leave a choice
constexpr float kViolatingCell = -14.0F;  // a free-space violation
constexpr float kOccludedCell = -1.5F;    // something in front: it may be an occluder
constexpr float kContinues = -6.0F;       // the surface goes on where the model ends

std::int16_t cell_score(const Expectation& expected, float height, float sigma) {
  if (std::isnan(height)) return 0;
  if (expected.nothing) {
    // Standard deviations: noise alone is beyond in one cell of seven.
    const bool continues = std::abs(height - expected.low) < 1.5F * sigma;
    return static_cast<std::int16_t>(continues ? kContinues : 0.0F);
  }
  if (height == kBelow && expected.low < -kDeepest) return 0;  // this may be what is expected
  const float above = (height - expected.high) / sigma;
  const float below = (expected.low - height) / sigma;
  const float most = expected.low == expected.high ? kExplainedCell : kInRange;
  const float deviation = std::max({above, below, 0.0F});
  const float fitting = most - kExplainedCell * 0.2F * deviation * deviation;
  return static_cast<std::int16_t>(
      std::max(fitting, above > below ? kOccludedCell : kViolatingCell));
}

/// Truncates: the library's rounding is a call, which took a thirtieth of a search.
int nearest_cell(float position) {
  constexpr int kBeyondAll = 4096;  // makes positions positive; maps are much smaller
  return static_cast<int>(position + (kBeyondAll + 0.5F)) - kBeyondAll;
}

/// Returns as many columns as can be summed up at once.
int padded(int columns) {
  constexpr int kBlock = static_cast<int>(kernels::kWindowBlock);
  return (columns + kBlock - 1) / kBlock * kBlock;
}

int halved_up(int cells) {
  return (cells + TemplateCorrelation::kShiftStep - 1) / TemplateCorrelation::kShiftStep;
}

}  // namespace

TemplateCorrelation::TemplateCorrelation(const HeightMap& map,
                                         const HeightTemplate& height_template, int margin)
    : map_(map),
      height_template_(height_template),
      margin_(margin),
      columns_(halved_up(map.width - 2 * margin)),
      rows_(halved_up(map.height - 2 * margin)),
      padded_columns_(padded(columns_)),
      next_row_(halved_up(map.width) + 1 + padded_columns_ - columns_),
      plane_rows_(halved_up(map.height) + 1) {
  const std::size_t cells = static_cast<std::size_t>(kShiftStep * kShiftStep) *
                            static_cast<std::size_t>(plane_rows_) *
                            static_cast<std::size_t>(next_row_);
  for (const Expectation& expectation : height_template.expectations) {
    auto& scores = cell_scores_.emplace_back(cells);
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const std::size_t cell = map.index(x, y);
        scores[index(x, y)] = cell_score(expectation, map.heights[cell], map.sigmas[cell]);
      }
    }
  }
  sums_.resize(static_cast<std::size_t>(padded_columns_) * static_cast<std::size_t>(rows_));
}

void TemplateCorrelation::turn_to(double angle) {
  const auto c = static_cast<float>(std::cos(angle) / map_.cell_size);
  const auto s = static_cast<float>(std::sin(angle) / map_.cell_size);
  windows_.clear();
  for (std::size_t i = 0; i < height_template_.cells.size(); i += kCellStep) {
    const TemplateCell& cell = height_template_.cells[i];
    const int dx = nearest_cell(c * cell.x - s * cell.y);
    const int dy = nearest_cell(s * cell.x + c * cell.y);
    windows_.push_back(cell_scores_[static_cast<std::size_t>(cell.expectation)].data() +
                       index(margin_ + dx, margin_ + dy));
  }
  kernels::add_windows({windows_, static_cast<std::size_t>(next_row_),
                        static_cast<std::size_t>(padded_columns_), static_cast<std::size_t>(rows_)},
                       sums_.data());
}

int TemplateCorrelation::exactly(double angle, double x, double y) const {
  const auto c = static_cast<float>(std::cos(angle) / map_.cell_size);
  const auto s = static_cast<float>(std::sin(angle) / map_.cell_size);
  const auto left = static_cast<float>(x + margin_);
  const auto top = static_cast<float>(y + margin_);
  int sum = 0;
  for (const TemplateCell& cell : height_template_.cells) {
    const int u = nearest_cell(left + c * cell.x - s * cell.y);
    const int v = nearest_cell(top + s * cell.x + c * cell.y);
    if (u < 0 || v < 0 || u >= map_.width || v >= map_.height) continue;
    sum += cell_scores_[static_cast<std::size_t>(cell.expectation)][index(u, v)];
  }
  return sum;
}

}  // namespace lockbox
