// SPDX-License-Identifier: BSD-3-Clause
// Which patches of an image show edges of the model, as far as a view of it tells; and if there is
// time for a few only, which of them tell most about joints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/terms/edge_patch.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// Reuses its buffers.
class EdgeSelection {
 public:
  static constexpr int kSide = EdgePatch::kSide;  ///< of a patch, pixels of the camera

  /// Tiles in whose pixels the inverse depth of the view bends by more than this (1/metre), or
  /// breaks. camera: that for which the surface was drawn.
  void select(const VisibleSurface& surface, const PinholeCamera& camera, float least_bend,
              const Executor& executor);

  /// Leaves those of them that tell most about each variable, so many of each. screws: by body,
  /// from a step of all unknowns to its twist in the camera's frame. variables: by body, those that
  /// move it. variance: of what a pixel measures, 1/metre^2.
  void keep_best(const VisibleSurface& surface, const std::vector<BodyJacobian>& screws,
                 const std::vector<std::vector<int>>& variables, float variance,
                 std::size_t of_each_variable, const Executor& executor);

  /// Rows of patches, from the image's first on; the last may reach beyond the image.
  std::size_t rows() const { return rows_.size(); }
  /// Returns the columns of patches that were selected in a row, from left to right.
  const std::vector<int>& columns(std::size_t row) const { return rows_[row].columns; }

 private:
  struct Row {
    std::vector<std::int32_t> bends;       ///< of a row of the view: the columns of pixels
    std::vector<Pixel> edges;              ///< pixels of the view in these patches that bend
    std::vector<std::uint8_t> shows_edge;  ///< by patch
    std::vector<int> candidates;           ///< patches that show an edge, in order
    std::vector<float> scores;             ///< by patch and variable
    std::vector<int> columns;
  };
  struct Score {
    float score;
    int row;
    int column;
  };

  void find_edges(const VisibleSurface& surface, float least_bend, int number, Row& row) const;
  void mark(int camera_column, Row& row) const;
  void score(const VisibleSurface& surface, const std::vector<BodyJacobian>& screws,
             const std::vector<std::vector<int>>& variables, float variance, Row& row) const;
  void find_best(std::size_t variable, std::size_t most);

  int columns_ = 0;
  std::size_t variables_ = 0;
  std::vector<Row> rows_;
  std::vector<Score> scores_;  ///< of all patches, for one variable
};

}  // namespace lockbox
