// SPDX-License-Identifier: BSD-3-Clause
// Steps that no single cell of a contour shows, but all of them together do: a board stands out
// from its wall by little more than a cell's noise.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "cell_classification.hpp"
#include "contour_lines.hpp"
#include "scene_cells.hpp"

namespace lockbox {

/// A cell of one of the model's lines that the scene seems to go on across.
struct UnseenCell {
  std::int32_t line;          ///< of the model
  int u;                      ///< column
  int v;                      ///< row
  Eigen::Vector2f direction;  ///< towards what the model does not go on to
};

/// Reuses its buffers.
class FaintSteps {
 public:
  struct Line {
    std::int32_t line;
    int cells;    ///< unseen ones
    double nats;  ///< log-likelihood ratio of a step across the line, against none
  };

  /// Weighs them by line. scene_lines are those that single cells do show: where one of them is
  /// near, it is the step, and lies elsewhere. Sorts the cells by line.
  std::span<const Line> weigh(std::span<UnseenCell> cells, const SceneCells& scene,
                              const ShownModel& model, const ContourLines& scene_lines);

 private:
  /// What was measured at some distance from a contour, inside or outside.
  struct Sample {
    int u;
    int v;
    float across;  ///< cells from the contour, positive outside
    float value;   ///< 1/metre
  };

  bool take_samples(const UnseenCell& cell, const SceneCells& scene, const ShownModel& model,
                    const ContourLines& scene_lines);
  double nats_of_samples(const SceneCells& scene);

  std::vector<Sample> samples_;  ///< of a line
  std::vector<int> windows_;     ///< in which they lie
  std::vector<Line> lines_;
};

}  // namespace lockbox
