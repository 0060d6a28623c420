// SPDX-License-Identifier: BSD-3-Clause
// Which pixels show the object, when it is only roughly known where it is: the surfaces near the
// expected place, without the table that it stands on and the wall that it hangs on.
//
// For the start, and for when tracking is lost: 10 to 30 ms for 640 x 480 pixels on one core, the
// more planes the longer.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"

namespace lockbox {

/// Where one body of the object is expected.
struct ExpectedBody {
  Eigen::Isometry3d T_camera_body = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d box;  ///< around all of the body, in its frame; empty: nothing to see
};

struct SegmentationOptions {
  /// Standard deviation of 1/depth, 1/metre: that of a depth z is depth_noise z^2, the law of
  /// sensors that triangulate.
  double depth_noise = 0.0022;
  /// Neighbouring samples farther apart than this, times the object's distance, belong to
  /// different clusters.
  double cluster_gap = 0.03;
  /// Less than this share of the pixels that the object should cover is no object.
  double min_coverage = 0.2;
};

class ObjectSegmenter {
 public:
  explicit ObjectSegmenter(const SegmentationOptions& options = {}) : options_(options) {}

  /// One byte a pixel of cloud.depth(): 1 where it shows the object. Nothing if no convincing
  /// object remains; all points are then the better guess. A plane of the scene is one that reaches
  /// beyond the object: a plane of which no more can be seen than the object could cover stays.
  /// margin: how far any point of the object may be from where it is expected, metres (up to about
  /// 0.2). Throws InputError if margin or poses are no finite numbers. Deterministic.
  std::optional<std::vector<std::uint8_t>> segment(const TiledCloud& cloud,
                                                   const std::vector<ExpectedBody>& bodies,
                                                   double margin) const;

 private:
  SegmentationOptions options_;
};

}  // namespace lockbox
