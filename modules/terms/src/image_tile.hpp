// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/core/pinhole_camera.hpp"

namespace lockbox {

/// Number of the cloud's tile that a pixel is in.
inline std::uint32_t tile_of(const Pixel& pixel, const PinholeCamera& camera) {
  const int columns = (camera.width + kTileSize - 1) / kTileSize;
  return static_cast<std::uint32_t>(pixel.v / kTileSize * columns + pixel.u / kTileSize);
}

}  // namespace lockbox
