// SPDX-License-Identifier: BSD-3-Clause
// The cloud as the registration reads it: a filtered depth image, of which points are made where
// they are wanted (image_points.hpp, thinned_points.hpp). A cloud without an image is cut into
// blocks of space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/cloud/cloud_options.hpp"
#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/parallel.hpp"

namespace lockbox {

/// Buffers are reused: assign() allocates only when the image size changes.
class TiledCloud {
 public:
  /// Converts and filters in one pass. Throws InputError if camera and depth do not fit together.
  void assign(const DepthFrame& frame, const CloudOptions& options, const Executor& executor);

  /// Does the same from depths in metres, row by row; what is not finite and positive was not
  /// measured. Throws InputError if camera and depth do not fit together.
  void assign(const PinholeCamera& camera, std::span<const float> depth,
              const CloudOptions& options, const Executor& executor);

  /// Takes points without an image, seen from the origin along z: depth() is empty, blocks() holds
  /// the points, whose pixel() is their number in the span. Points that are not finite, or not in
  /// front, are left out. Of the camera only the focal lengths mean something: how exact the points
  /// are across their rays.
  void assign_unorganized(std::span<const Eigen::Vector3f> points, const PinholeCamera& camera);

  /// Returns whether there is an image: depth() and pixels, to look things up in.
  bool has_image() const { return !depth_.empty(); }

  /// Returns the points of a cloud without an image, in blocks of space, metres, camera frame. It
  /// is empty if there is an image.
  const PointTiles& blocks() const { return blocks_; }

  /// Keeps only points whose pixel is set in the mask (one byte a pixel); depth() stays as it is.
  /// Throws InputError if the mask has another size than the image.
  void keep(const std::vector<std::uint8_t>& mask);

  /// Returns the camera of the image that the cloud was made of.
  const PinholeCamera& camera() const { return camera_; }
  /// Returns the filtered depth image in metres, width * height values, 0 where nothing is known.
  const std::vector<float>& depth() const { return depth_; }
  /// Returns whether keep() was called.
  bool is_masked() const { return !mask_.empty(); }
  /// Returns whether the points of that pixel were kept; all are unless keep() was called.
  bool keeps(std::size_t pixel) const { return mask_.empty() || mask_[pixel] != 0; }

 private:
  class Blocks : public PointTiles {
   public:
    void assign(std::span<const Eigen::Vector3f> points);
  };

  void resize(const PinholeCamera& camera);
  template <typename ReadRow>
  void convert(const ReadRow& read_row, const CloudOptions& options, const Executor& executor);

  PinholeCamera camera_;
  std::vector<float> measured_;  ///< metres, 0 where nothing was; a border of zeros around them
  std::vector<float> depth_;
  std::vector<std::uint8_t> mask_;  ///< of keep(), if it was called
  Blocks blocks_;
};

}  // namespace lockbox
