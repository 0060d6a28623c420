// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/terms/model_term.hpp"

namespace lockbox {

/// Memory for one tile: arrays of all its candidates.
struct ModelTileScratch {
  /// Bodies that may compete for a tile's points; no others are looked up there. Source: not
  /// recorded. Doubled, each thread keeps twice the memory.
  static constexpr std::size_t kMaxCandidates = 16;

  explicit ModelTileScratch(std::vector<float>& memory) {
    memory.resize(kMaxCandidates * kArraysPerCandidate * kTilePoints);
    float* next = memory.data();
    const auto take = [&next] {
      float* array = next;
      next += kTilePoints;
      return array;
    };
    for (std::size_t l = 0; l < kMaxCandidates; ++l) {
      hits[l] = {take(), take(), {take(), take(), take()}, {take(), take(), take()}, nullptr};
      weight[l] = take();
      frozen_distance[l] = take();
    }
  }

  std::array<kernels::FieldHits, kMaxCandidates> hits;  ///< by candidate
  std::array<float*, kMaxCandidates> weight;
  std::array<float*, kMaxCandidates> frozen_distance;

  /// What the candidates of a chunk, from `first` on, have found of a tile.
  kernels::Candidates candidates(const ModelTerm::Scene& scene, const ModelTermChunk& chunk,
                                 std::size_t first, std::size_t count, const Tile& tile) {
    for (std::size_t l = 0; l < count; ++l) {
      inverse_variance_[l] = chunk.inverse_variance.data() + (first + l) * kTilePoints;
    }
    return {tile.padded,
            {distance.data(), count},
            {inverse_variance_.data(), count},
            {chunk.body_numbers.data() + first, count},
            scene.predicted.body.data() + tile.first,
            scene.points.averaged_pixels().data() + tile.first,
            static_cast<float>(scene.options.gate * chunk.annealing_sigma),
            static_cast<float>(scene.options.gate),
            static_cast<float>(scene.options.visible_odds)};
  }
  std::array<const float*, kMaxCandidates> distance;  ///< to be set before candidates()

 private:
  static constexpr std::size_t kArraysPerCandidate = 10;  ///< that the constructor takes

  std::array<const float*, kMaxCandidates> inverse_variance_;
};

}  // namespace lockbox
