// SPDX-License-Identifier: BSD-3-Clause
// Points of the model and where they should go, body by body, as the inner loops read them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/kernels/correspondences.hpp"

namespace lockbox {

/// residual = direction . (T_camera_body p_body - target).
struct FreeSpaceCorrespondence {
  Eigen::Vector3f p_body;
  Eigen::Vector3f target;     ///< camera frame
  Eigen::Vector3f direction;  ///< unit vector, camera frame
  float variance;             ///< of the residual by the sensor's noise, m^2
  float direction_variance;   ///< squared radians
  float pixels;               ///< that it stands for
  int body;
  std::uint32_t tile;  ///< of the cloud, that the sample is seen in
};

/// Filled chunk by chunk, by whoever finds the correspondences. Reuses its buffers.
class CorrespondenceSet {
 public:
  /// Correspondences of one body, few enough to be summed in single precision.
  struct Block {
    int body;
    std::size_t first;
    std::size_t count;
  };

  /// So many empty chunks, for correspondences to be put into.
  void begin(std::size_t chunks);
  std::vector<FreeSpaceCorrespondence>& chunk(std::size_t i) { return chunks_[i]; }
  /// Lays out what the chunks contain by now.
  void finish(std::size_t bodies);

  std::span<const std::vector<FreeSpaceCorrespondence>> chunks() const {
    return {chunks_.data(), count_};
  }
  std::size_t size() const;

  const std::vector<Block>& blocks() const { return blocks_; }
  kernels::CorrespondenceSpan span(const Block& block) const;

  /// Past the last of the correspondences from this one on, before `end`, that are in the same tile
  /// and stand for as many pixels: neighbours mostly follow each other.
  std::size_t end_of_run(std::size_t correspondence, std::size_t end) const;

  /// Returns the tile of a correspondence that is laid out.
  std::size_t tile(std::size_t correspondence) const { return tiles_[correspondence]; }
  float pixels_of(std::size_t correspondence) const { return arrays_[pixels][correspondence]; }
  /// Returns its point of the model, body frame.
  Eigen::Vector3f point(std::size_t correspondence) const {
    return {arrays_[px][correspondence], arrays_[py][correspondence], arrays_[pz][correspondence]};
  }

 private:
  enum Number { px, py, pz, tx, ty, tz, dx, dy, dz, variance, direction_variance, pixels, numbers };

  void lay_out(std::size_t bodies);

  std::vector<std::vector<FreeSpaceCorrespondence>> chunks_;  ///< more are kept for later
  std::size_t count_ = 0;                                     ///< of them, in use
  std::array<std::vector<float>, numbers> arrays_;
  std::vector<std::uint32_t> tiles_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> next_;  ///< by body: where its next correspondence goes
};

}  // namespace lockbox
