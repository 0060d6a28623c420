// SPDX-License-Identifier: BSD-3-Clause
// What each cell of the scene says, by itself, of the surface that the model shows there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/verification/evidence.hpp"
#include "scene_cells.hpp"

namespace lockbox {

/// What the model shows, in the scene's cells.
struct ShownModel {
  RenderedDepth image;
  std::vector<float> cells;  ///< 1/metre; 0: nothing

  std::size_t index(int u, int v) const { return image.index(u, v); }
  double at(int u, int v) const { return static_cast<double>(cells[index(u, v)]); }
};

enum class Seen : std::uint8_t { nothing, explained, occluder, behind };

/// Reuses its buffers.
class CellClassification {
 public:
  /// Classifies all cells that the model shows. Returns what they say: misfit, what is seen
  /// through, and how many there are.
  Evidence classify(const SceneCells& scene, const ShownModel& model, std::size_t bodies,
                    const Executor& executor);

  Seen at(std::size_t cell) const { return seen_[cell]; }

  /// Whether enough is seen of that body for lines on it to tell anything.
  bool tells(std::int16_t body) const { return is_mute_[static_cast<std::size_t>(body)] == 0; }

 private:
  void classify_row(const SceneCells& scene, const ShownModel& model, int v);
  void find_mute_bodies(const ShownModel& model, std::size_t bodies, double least_seen);

  std::vector<Seen> seen_;
  std::vector<Evidence> rows_;
  std::vector<int> explained_cells_;   ///< by body
  std::vector<int> hidden_cells_;      ///< by body
  std::vector<std::uint8_t> is_mute_;  ///< by body: what shows of it may be anything
};

}  // namespace lockbox
