// SPDX-License-Identifier: BSD-3-Clause
// Flat pieces of what the camera sees, small ones too, and parallel ones a few millimetres apart.
//
// A plane m.p = 1 has the inverse depth 1/z = m.r along the ray r = (x/z, y/z, 1): planes are found
// by linear fits, under noise that is the same everywhere for a sensor that triangulates.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/verification/coarse_view.hpp"

namespace lockbox {

struct PlanarRegion {
  Eigen::Vector3f m;                 ///< of the plane m.p = 1, 1/metre, camera frame
  std::vector<std::size_t> samples;  ///< of the view that lie in it and hang together
};

/// The largest regions, the largest first, of at least least_samples; noise: standard deviation of
/// 1/depth of a sample, 1/metre. Overlapping pieces of one plane count once.
std::vector<PlanarRegion> find_planar_regions(const CoarseView& view, double noise,
                                              std::size_t least_samples, std::size_t most_regions);

/// A view, and its planes.
struct PlanarScene {
  const CoarseView& view;
  double noise;  ///< standard deviation of 1/depth of a sample, 1/metre
  std::vector<PlanarRegion> regions;
};

/// The planar regions that the search uses: the 32 best of 20 samples and more.
PlanarScene find_planes(const CoarseView& view, double noise);

/// Origin in the middle of the region, z towards the camera's side.
Eigen::Isometry3d region_frame(const CoarseView& view, const PlanarRegion& region);

}  // namespace lockbox
