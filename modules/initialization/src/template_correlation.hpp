// SPDX-License-Identifier: BSD-3-Clause
// A template laid onto a map of heights at every shift, for one turn after the other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "height_map.hpp"
#include "height_template.hpp"

namespace lockbox {

/// What all cells of the template explained would score.
inline constexpr float kExplainedCell = 8.0F;

/// The scores of a template laid onto a map. Map and template are referred to.
class TemplateCorrelation {
 public:
  /// Shifts are summed up for every other cell; the best are moved by single cells and less
  /// afterwards. Halved, proposals take up to twice as long, and as many of 88 tuning scenes are
  /// right.
  static constexpr int kShiftStep = 2;
  /// One of the template's cells in so many is looked at for sums.
  static constexpr std::size_t kCellStep = 3;

  /// margin: cells around the map at which the template's origin is not laid, no fewer than its
  /// radius.
  TemplateCorrelation(const HeightMap& map, const HeightTemplate& height_template, int margin);

  /// Sums up the template turned by the angle, radians, for all its shifts (columns x rows).
  void turn_to(double angle);

  /// Returns the sum of the turn, at that shift of kShiftStep cells each.
  int sum(int column, int row) const {
    return int{sums_[static_cast<std::size_t>(row) * static_cast<std::size_t>(padded_columns_) +
                     static_cast<std::size_t>(column)]};
  }

  /// The sum over all cells of the template, at a place in cells of the map without its margin.
  int exactly(double angle, double x, double y) const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  using Score = std::int16_t;

  /// Returns the index of a score of one expectation: by parity of the row, of the column, then
  /// every other row and column, so that shifts by two cells are neighbours.
  std::size_t index(int x, int y) const {
    const int plane = (y & 1) * kShiftStep + (x & 1);
    return (static_cast<std::size_t>(plane) * static_cast<std::size_t>(plane_rows_) +
            static_cast<std::size_t>(y / kShiftStep)) *
               static_cast<std::size_t>(next_row_) +
           static_cast<std::size_t>(x / kShiftStep);
  }

  const HeightMap& map_;
  const HeightTemplate& height_template_;
  int margin_;
  int columns_;
  int rows_;
  int padded_columns_;
  int next_row_;                                 ///< scores from row to row of a plane, padded
  int plane_rows_;                               ///< of each of the four planes
  std::vector<std::vector<Score>> cell_scores_;  ///< by expectation; 0 in the padding
  std::vector<const Score*> windows_;
  std::vector<Score> sums_;
};

}  // namespace lockbox
