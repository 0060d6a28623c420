// SPDX-License-Identifier: BSD-3-Clause
// Why an object may not have been found, as far as the depths alone tell.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lockbox/core/depth_frame.hpp"

namespace lockbox::app {

/// What the depths of frames are like, all frames together.
class DepthSurvey {
 public:
  /// max_depth: metres; the tracker drops what is measured farther.
  explicit DepthSurvey(double max_depth) : max_depth_(max_depth), pixels_of_(kDepths, 0) {}

  /// All frames must have the unit of the first.
  void add(const DepthFrame& frame);

  /// A sentence without a full stop: the share of pixels with a depth, their range, and what looks
  /// wrong about that.
  std::string findings() const;

 private:
  static constexpr std::size_t kDepths = 65536;  // values of a pixel

  std::size_t measured_pixels() const;
  double quantile(double share) const;  ///< metres, of the pixels with a depth
  double share_beyond() const;          ///< of max_depth, of the pixels with a depth

  double max_depth_;
  double metres_per_unit_ = 0.0;
  std::size_t pixels_ = 0;
  std::vector<std::size_t> pixels_of_;  ///< by depth, units; 0: not measured
};

}  // namespace lockbox::app
