// SPDX-License-Identifier: BSD-3-Clause
// Points as the registration reads them: tiles of neighbours, structure of arrays. Neighbours
// mostly see the same bodies, so bodies are matched to whole tiles.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lockbox {

inline constexpr int kTileSize = 16;  ///< pixels along each side of a full tile of an image
inline constexpr std::size_t kTilePoints = std::size_t{kTileSize} * kTileSize;

/// One tile: its valid points are [first, first + count) of the arrays, padded with points outside
/// everything up to a multiple of kernels::kLanes.
struct Tile {
  std::size_t first = 0;       ///< index of the first point
  std::size_t count = 0;       ///< valid points
  std::size_t padded = 0;      ///< points with the padding
  Eigen::AlignedBox3f bounds;  ///< of the valid points, camera frame
  double weight = 1.0;         ///< pixels that each of its points stands for
  double scatter = 0.0;  ///< variance of pixels around the points that are their means, whitened
};

/// The points of a cloud, tile by tile. Who fills it derives from it.
class PointTiles {
 public:
  /// Returns the tiles, whose points do not overlap.
  const std::vector<Tile>& tiles() const { return tiles_; }
  const std::vector<float>& x() const { return x_; }  ///< metres, camera frame, as are y() and z()
  /// Metres, camera frame.
  const std::vector<float>& y() const { return y_; }
  /// Metres, camera frame.
  const std::vector<float>& z() const { return z_; }
  /// Returns the image index (v * width + u) of each point.
  const std::vector<std::uint32_t>& pixel() const { return pixel_; }
  /// Returns how many pixels each point is the mean of.
  const std::vector<float>& averaged_pixels() const { return averaged_pixels_; }
  /// Returns how many points all tiles have together, without the padding.
  std::size_t valid_points() const;

 protected:
  PointTiles() = default;

  /// Makes room for so many tiles of kTilePoints each.
  void resize_tiles(std::size_t count);
  /// Sets bounds and padding of a tile whose points are in place.
  void finish_tile(Tile& tile);
  /// Sets the padding of such a tile alone.
  void pad(Tile& tile);

  std::vector<Tile> tiles_;             ///< of the points below
  std::vector<float> x_;                ///< metres, camera frame
  std::vector<float> y_;                ///< metres, camera frame
  std::vector<float> z_;                ///< metres, camera frame
  std::vector<std::uint32_t> pixel_;    ///< image index of each point
  std::vector<float> averaged_pixels_;  ///< pixels that each point is the mean of
};

}  // namespace lockbox
