// SPDX-License-Identifier: BSD-3-Clause
// Where surfaces end or bend in an image of inverse depths, joined to lines: a cell of a straight
// edge is no news once the edge is known, so that an edge tells once, however many cells it has.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "scene_cells.hpp"

namespace lockbox {

/// Reuses its buffers.
class ContourLines {
 public:
  /// Of the cells of a row: how many of their sights end, and the sum of the ways of these.
  struct Ends {
    std::vector<float> count;
    std::vector<float> u;
    std::vector<float> v;
  };

  /// Finds lines of cells of the scene's size, 1/metre, 0 in blank ones, at which what is beside
  /// them ends. What deviates by no more than this share of its noise and the model's tolerance is
  /// no contour.
  void find(const SceneCells& scene, std::span<const float> cells, double share,
            const Executor& executor);
  /// Joins what was found to lines.
  void join_lines(const SceneCells& scene);

  /// A vector towards what the cell's surface does not go on to; zero where it goes on, and
  /// where nothing is known.
  const Eigen::Vector2f& direction(std::size_t cell) const { return directions_[cell]; }

  /// The number of the line through a cell that has a direction, once they are joined.
  std::int32_t line(std::size_t cell) const { return lines_[cell]; }
  int cells_of_line(std::size_t cell) const { return length(line(cell)); }
  int length(std::int32_t line) const { return lengths_[static_cast<std::size_t>(line)]; }

  /// Whether one with about this direction passes within so many cells.
  bool passes(const SceneCells& scene, int u, int v, int reach,
              const Eigen::Vector2f& direction) const;

  /// Whether something that ends on both sides, too narrow to say towards which, is within so many
  /// cells.
  bool has_strip(const SceneCells& scene, int u, int v, int reach) const;

 private:
  void find_in_row(const SceneCells& scene, std::span<const float> cells, double share, int v);
  void smooth_row(const SceneCells& scene, int v);
  void join(const SceneCells& scene, int u, int v);

  std::vector<Eigen::Vector2f> directions_;
  std::vector<Eigen::Vector2f> raw_;
  std::vector<std::uint8_t> strips_;
  std::vector<Ends> ends_;           ///< by worker
  std::vector<std::int32_t> lines_;  ///< -1: none yet
  std::vector<int> lengths_;
  std::vector<std::pair<int, int>> open_;
};

}  // namespace lockbox
