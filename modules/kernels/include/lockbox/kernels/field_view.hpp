// SPDX-License-Identifier: BSD-3-Clause
// What the inner loops read of a signed distance field: plain arrays, no ownership.
//
// A field has two resolutions over one array of samples: a coarse dense grid that reaches far
// beyond the body, and fine blocks near its surface. Both are read by the same tri-linear code:
//
//   g    = (p - origin) / voxel                  grid coordinates, sample i lies at g = i
//   fine : cell c = floor(g), block b = c >> 3; first = block_first[b]; if first >= 0 the eight
//          corners of the cell are samples[first + (c & 7) . (1, 9, 81) + {0,1}.(1, 9, 81)]
//   else : the same with coarse_origin, coarse_voxel, first = 0 and strides (1, sx, sx sy)
//
// A fine block has 8 x 8 x 8 cells and stores 9 x 9 x 9 samples, so that a cell never reads from
// two blocks. x runs fastest: two neighbours in x are one 32-bit load.
#pragma once

#include <cstdint>

namespace lockbox {

inline constexpr int kBlockCells = 8;
inline constexpr int kBlockSamples = kBlockCells + 1;
inline constexpr int kBlockVolume = kBlockSamples * kBlockSamples * kBlockSamples;

/// The arrays and grids of one field. Whoever owns them keeps them alive.
struct FieldView {
  /// Distances in units of fine_scale or coarse_scale: first the coarse grid, then the blocks.
  /// One spare sample follows the last, because pairs are loaded.
  const std::int16_t* samples = nullptr;
  /// First sample of each fine block (x fastest), -1 where the block is not stored.
  const std::int32_t* block_first = nullptr;

  float fine_origin[3] = {};    ///< position of fine sample (0, 0, 0), metres, body frame
  float fine_voxel = 1.0F;      ///< metres between fine samples
  float fine_scale = 1.0F;      ///< metres per unit of a fine sample
  std::int32_t blocks[3] = {};  ///< fine blocks along each axis

  float coarse_origin[3] = {};       ///< position of coarse sample (0, 0, 0), metres, body frame
  float coarse_voxel = 1.0F;         ///< metres between coarse samples
  float coarse_scale = 1.0F;         ///< metres per unit of a coarse sample
  std::int32_t coarse_size[3] = {};  ///< samples along each axis
};

}  // namespace lockbox
