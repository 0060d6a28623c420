// SPDX-License-Identifier: BSD-3-Clause
// The organized cloud as the registration reads it: square image tiles of points, structure of
// arrays. Neighbouring pixels mostly see the same bodies, so bodies are matched to whole tiles. A
// cloud without an image is cut into blocks of space instead.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/parallel.hpp"

namespace lockbox {

struct CloudOptions {
  double min_depth = 0.2;  ///< metres; nearer measurements are dropped
  double max_depth = 5.0;  ///< metres; farther measurements are dropped
  /// A pixel that differs from both neighbours of a row or column by more than this, times its
  /// depth squared, hangs in the air between two surfaces (1 / metre). 0 keeps all.
  double flying_pixel_jump = 0.02;
};

inline constexpr int kTileSize = 16;  ///< pixels along each side
inline constexpr std::size_t kTilePoints = std::size_t{kTileSize} * kTileSize;

/// One tile: its valid points are [first, first + count) of the cloud's arrays, padded with points
/// outside everything up to a multiple of kernels::kLanes.
struct Tile {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t padded = 0;
  Eigen::AlignedBox3f bounds;  ///< of the valid points, camera frame
};

/// Buffers are reused: assign() allocates only when the image size changes.
class TiledCloud {
 public:
  /// Converts and filters in one pass. Throws InputError if camera and depth do not fit together.
  void assign(const DepthFrame& frame, const CloudOptions& options, const Executor& executor);

  /// The same from depths in metres, row by row; what is not finite and positive was not measured.
  void assign(const PinholeCamera& camera, std::span<const float> depth,
              const CloudOptions& options, const Executor& executor);

  /// Points without an image, seen from the origin along z: depth() is empty, pixel() the number of
  /// the point in the span. Points that are not finite, or not in front, are left out. Of the
  /// camera only the focal lengths mean something: how exact the points are across their rays.
  void assign_unorganized(std::span<const Eigen::Vector3f> points, const PinholeCamera& camera);

  /// Whether there is an image: depth() and pixels, to look things up in.
  bool has_image() const { return !depth_.empty(); }

  /// Keeps only points whose pixel is set in the mask (one byte a pixel); depth() stays as it is.
  /// Throws InputError if the mask has another size than the image.
  void keep(const std::vector<std::uint8_t>& mask);

  const PinholeCamera& camera() const { return camera_; }
  const std::vector<Tile>& tiles() const { return tiles_; }
  const std::vector<float>& x() const { return x_; }
  const std::vector<float>& y() const { return y_; }
  const std::vector<float>& z() const { return z_; }
  /// Image index (v * width + u) of each point.
  const std::vector<std::uint32_t>& pixel() const { return pixel_; }
  /// The point of a pixel of the image, if it has one: an index of x(), y(), z().
  std::optional<std::size_t> point_at(int u, int v) const;
  /// Filtered depth image in metres, 0 where nothing is known; width * height.
  const std::vector<float>& depth() const { return depth_; }
  std::size_t valid_points() const;

 private:
  void resize(const PinholeCamera& camera);
  template <typename Depth>
  void convert(const Depth& raw, const CloudOptions& options, const Executor& executor);
  template <typename Depth>
  void filter_rows(const Depth& raw, const CloudOptions& options, int first_row, int last_row);
  void fill_tile(int column, int row);
  void resize_tiles(std::size_t count);
  void finish_tile(Tile& tile);

  PinholeCamera camera_;
  std::vector<float> depth_;
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> z_;
  std::vector<std::uint32_t> pixel_;
  std::vector<Tile> tiles_;
  int tile_columns_ = 0;
};

}  // namespace lockbox
