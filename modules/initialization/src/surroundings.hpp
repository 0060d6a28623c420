// SPDX-License-Identifier: BSD-3-Clause
// The table that the object stands on, the wall that it hangs on. Where they touch the object, a
// registration with wide gates takes them for it and leaves even the true pose: a cabinet by 40 mm
// or 6 degrees. They are told by where the rest of them is. ObjectSegmenter (cloud) tells them by
// more, in tens of milliseconds; here hundreds of hypotheses are waiting.
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/model/configuration.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "planar_regions.hpp"

namespace lockbox {

/// A cloud with points left out; reused, it allocates nothing.
struct PartOfCloud {
  TiledCloud cloud;
  std::vector<std::uint8_t> mask;  ///< by pixel: 1 where it is kept
};

class Surroundings {
 public:
  explicit Surroundings(const KinematicTree& tree);

  void set_scene(const PlanarScene& scene);

  /// The cloud without points of planes of which most is elsewhere than the model in this
  /// configuration; its depth image is the same. The cloud's image has a whole number of times as
  /// many columns and rows as the view. noise: standard deviation of a pixel's 1/depth, 1/metre.
  /// The result is the cloud itself or in `part`.
  const TiledCloud& left_out_of(const TiledCloud& cloud, const Configuration& configuration,
                                double noise, PartOfCloud& part) const;

 private:
  std::vector<std::uint8_t> planes_elsewhere(const Configuration& configuration) const;

  const KinematicTree& tree_;
  std::vector<Eigen::AlignedBox3d> boxes_;            ///< by body
  PinholeCamera camera_;                              ///< of the view
  std::vector<Eigen::Vector3f> planes_;               ///< m of m.p = 1, by region
  std::vector<std::vector<Eigen::Vector3d>> points_;  ///< of each region some, camera frame
  std::vector<std::int16_t> region_at_;  ///< by sample of the view: in or beside which, or -1
};

}  // namespace lockbox
