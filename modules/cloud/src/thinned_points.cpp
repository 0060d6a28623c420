// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/cloud/thinned_points.hpp"

#include <algorithm>

#include "pixel_rays.hpp"

namespace lockbox {

/// Fills tile after tile. A tile holds points of one spacing, from neighbouring cells.
class ThinnedPoints::Gatherer {
 public:
  Gatherer(ThinnedPoints& points, const TiledCloud& cloud, const SamplingDensity& density)
      : points_(points), cloud_(cloud), density_(density), rays_(cloud.camera()) {
    points_.tiles_.clear();
  }

  void gather(int spacing, double weight) {
    weight_ = weight;
    // A block of cells that fills a tile.
    const int block = 2 * spacing;
    for (int row = 0; row < density_.rows; row += block) {
      for (int column = 0; column < density_.columns; column += block) {
        gather_block(column, row, block, spacing);
      }
    }
    finish();
  }

 private:
  static constexpr std::size_t kWellFilled = kTilePoints / 2;

  void gather_block(int column, int row, int block, int spacing) {
    for (int r = row; r < std::min(row + block, density_.rows); ++r) {
      for (int c = column; c < std::min(column + block, density_.columns); ++c) {
        const auto cell = static_cast<std::size_t>(r) * static_cast<std::size_t>(density_.columns) +
                          static_cast<std::size_t>(c);
        if (density_.spacing[cell] == spacing) gather_cell(c, r, spacing);
      }
    }
    if (count_ >= kWellFilled) finish();
  }

  void gather_cell(int column, int row, int spacing) {
    const int size = SamplingDensity::kCellSize;
    const auto most = static_cast<std::size_t>((size / spacing) * (size / spacing));
    if (count_ + most > kTilePoints) finish();
    reserve_tile();
    const int scale = density_.scale;
    const PinholeCamera& camera = cloud_.camera();
    std::size_t slot = points_.tiles_.size() * kTilePoints + count_;
    const std::size_t first = slot;
    for (int i = SamplingDensity::first_sample(spacing); i < size; i += spacing) {
      const int v = (row * size + i) * scale + scale / 2;
      if (v >= camera.height) break;
      const float ray_y = rays_.y(v);
      for (int j = SamplingDensity::first_sample(spacing); j < size; j += spacing) {
        const int u = (column * size + j) * scale + scale / 2;
        if (u >= camera.width) break;
        const auto pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
                           static_cast<std::size_t>(u);
        const float z = cloud_.depth()[pixel];
        if (z > 0.0F && cloud_.keeps(pixel)) {
          points_.x_[slot] = rays_.x(u) * z;
          points_.y_[slot] = ray_y * z;
          points_.z_[slot] = z;
          points_.pixel_[slot] = static_cast<std::uint32_t>(pixel);
          ++slot;
        }
      }
    }
    count_ += slot - first;
  }

  void reserve_tile() {
    const std::size_t slots = (points_.tiles_.size() + 1) * kTilePoints;
    if (points_.x_.size() >= slots) return;
    for (auto* axis : {&points_.x_, &points_.y_, &points_.z_}) axis->resize(slots);
    points_.pixel_.resize(slots);
    points_.averaged_pixels_.resize(slots, 1.0F);
  }

  void finish() {
    if (count_ == 0) return;
    Tile tile;
    tile.first = points_.tiles_.size() * kTilePoints;
    tile.count = count_;
    tile.weight = weight_;
    points_.finish_tile(tile);
    points_.tiles_.push_back(tile);
    count_ = 0;
  }

  ThinnedPoints& points_;
  const TiledCloud& cloud_;
  const SamplingDensity& density_;
  PixelRays rays_;
  double weight_ = 1.0;
  std::size_t count_ = 0;  ///< points of the tile in hand
};

void ThinnedPoints::assign(const TiledCloud& cloud, const SamplingDensity& density) {
  Gatherer gatherer(*this, cloud, density);
  for (int spacing = 1; spacing <= SamplingDensity::kCellSize; spacing *= 2) {
    const int along = spacing * density.scale;
    gatherer.gather(spacing, static_cast<double>(along) * along);
  }
}

}  // namespace lockbox
