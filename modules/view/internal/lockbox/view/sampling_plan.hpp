// SPDX-License-Identifier: BSD-3-Clause
// Where the view of a model tells most: at the contours and the creases of its parts. In the middle
// of a plane one point says what its neighbours say, and of the plane's own motion nothing; what
// tells how far a slider has gone are the few points at its ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/cloud/thinned_points.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/view/view_edges.hpp"

namespace lockbox {

class SamplingPlan {
 public:
  /// Spends about that many samples on the cells that show the model, edges first, those of small
  /// bodies before those of large ones. edges: of the view. scale: pixels of the camera along a
  /// pixel of the view, whose focal length is fx. reach: metres beside the model where its points
  /// may be; there samples are few.
  void plan(const RenderedDepth& view, const ViewEdges& edges, int scale, double fx, double reach,
            std::size_t budget, const Executor& executor);

  const SamplingDensity& density() const { return density_; }

 private:
  /// Pixels of a cell at edges of one body, or some of them.
  struct Edges {
    std::uint32_t cell;
    std::int16_t body;
    std::uint16_t pixels;
  };
  /// A row of cells.
  struct Band {
    std::vector<Edges> edges;
    std::vector<std::size_t> latest;  ///< of them, by column of cells
    float nearest = 0.0F;             ///< metres, of its edges
  };

  void count_edges(const RenderedDepth& view, const ViewEdges& edges, std::size_t row_of_cells);
  static void add_edge(std::uint32_t first_cell, int column, std::int16_t body, Band& band);
  void score_cells();
  void mark_cells_beside(int cells);
  void spend(std::size_t budget);

  SamplingDensity density_;
  std::vector<Band> bands_;
  std::vector<std::uint8_t> shows_model_;  ///< by cell
  std::vector<std::uint8_t> is_beside_;    ///< by cell: near the model, or showing it
  std::vector<float> scores_;              ///< by cell: 0 without edges
  std::vector<std::uint32_t> edge_cells_;
  std::vector<std::size_t> edges_of_body_;
};

}  // namespace lockbox
