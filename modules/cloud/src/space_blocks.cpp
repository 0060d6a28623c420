// SPDX-License-Identifier: BSD-3-Clause
// Blocks of a cloud without an image: the points are halved across the longest side of their box
// until a tile holds them, so that tiles are compact and, but for the last, full.
#include <algorithm>

#include "lockbox/cloud/tiled_cloud.hpp"

namespace lockbox {
namespace {

using Indices = std::span<std::uint32_t>;

class SpatialOrder {
 public:
  explicit SpatialOrder(std::span<const Eigen::Vector3f> points) : points_(points) {}

  void sort(Indices part) const {
    if (part.size() <= kTilePoints) {
      return;
    }
    Eigen::AlignedBox3f box;
    for (const std::uint32_t i : part) {
      box.extend(points_[i]);
    }
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t tiles = (part.size() + kTilePoints - 1) / kTilePoints;
    const std::size_t half = tiles / 2 * kTilePoints;
    // Equal coordinates go by number, for a result that does not hang on the library.
    const auto before = [this, axis](std::uint32_t a, std::uint32_t b) {
      return points_[a][axis] < points_[b][axis] || (points_[a][axis] == points_[b][axis] && a < b);
    };
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(half), part.end(),
                     before);
    sort(part.first(half));
    sort(part.subspan(half));
  }

 private:
  std::span<const Eigen::Vector3f> points_;
};

}  // namespace

void TiledCloud::Blocks::assign(std::span<const Eigen::Vector3f> points) {
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite() && points[i].z() > 0.0F) {
      order.push_back(static_cast<std::uint32_t>(i));
    }
  }
  SpatialOrder(points).sort(order);
  resize_tiles((order.size() + kTilePoints - 1) / kTilePoints);
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    Tile& tile = tiles_[t];
    tile.first = t * kTilePoints;
    tile.count = std::min(kTilePoints, order.size() - tile.first);
    for (std::size_t slot = tile.first; slot < tile.first + tile.count; ++slot) {
      const Eigen::Vector3f& p = points[order[slot]];
      x_[slot] = p.x();
      y_[slot] = p.y();
      z_[slot] = p.z();
      pixel_[slot] = order[slot];
    }
    finish_tile(tile);
  }
}

}  // namespace lockbox
