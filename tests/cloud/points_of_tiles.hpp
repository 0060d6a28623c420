// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/cloud/point_tiles.hpp"

namespace lockbox {

/// Calls visit(index) for all valid points.
template <typename Visit>
void for_each_point(const PointTiles& points, const Visit& visit) {
  for (const Tile& tile : points.tiles()) {
    for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
      visit(i);
    }
  }
}

}  // namespace lockbox
