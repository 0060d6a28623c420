// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/terms/model_term.hpp"
#include "lockbox/terms/model_term_chunk.hpp"
#include "model_tile_scratch.hpp"

namespace lockbox {

/// The model term of one tile of points, which the candidates of its chunk compete for. Scene and
/// bodies are referred to.
class ModelTile {
 public:
  ModelTile(const ModelTerm::Scene& scene, std::span<const PosedBody> bodies,
            std::size_t tile_index, std::size_t tile_of_chunk)
      : scene_(scene), bodies_(bodies), tile_index_(tile_index), tile_of_chunk_(tile_of_chunk) {}

  /// Where its points see each candidate, and which planes they see in place of a nearest surface.
  void look_up(ModelTileScratch& scratch, ModelTermChunk& chunk) const;

  /// What these look-ups, in the scratch memory, say of the bodies.
  void linearize(ModelTileScratch& scratch, ModelTermChunk& chunk) const;

  /// The cost under a selection that was made at other poses. current: whose look-ups the scratch
  /// memory holds, if any.
  double frozen_cost(const ModelTermChunk& frozen, const ModelTermChunk* current,
                     ModelTileScratch& scratch) const;

 private:
  const Tile& tile() const { return scene_.points.tiles()[tile_index_]; }

  const ModelTerm::Scene& scene_;
  std::span<const PosedBody> bodies_;
  std::size_t tile_index_;     ///< of the points
  std::size_t tile_of_chunk_;  ///< its number there
};

}  // namespace lockbox
