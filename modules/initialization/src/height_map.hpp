// SPDX-License-Identifier: BSD-3-Clause
// A view resampled into the frame of a plane: how high what the camera saw stands over it.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "lockbox/verification/coarse_view.hpp"
#include "planar_regions.hpp"

namespace lockbox {

/// Metres under the plane to which heights are told apart. What is seen deeper through a cell lies
/// far from it in the map, as the view is oblique: its height is kBelow.
inline constexpr float kDeepest = 0.05F;
inline constexpr float kBelow = -1e3F;

/// What stands over a plane, in the plane's frame.
struct HeightMap {
  Eigen::Isometry3d T_camera_plane;
  int width;
  int height;
  int margin;              ///< cells on each side that belong to it so that templates fit in
  Eigen::Vector2d corner;  ///< centre of cell (0, 0), plane frame
  double cell_size;
  std::vector<float> heights;  ///< metres, or kBelow; NaN: nothing known
  std::vector<float> sigmas;   ///< standard deviations of the heights

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

struct HeightMapSize {
  double cell;    ///< metres
  double beyond;  ///< metres that the map reaches beyond the region at least
  int margin;     ///< cells more on each side
};

/// Maps what is seen over the region's plane. noise: standard deviation of 1/depth of a pixel,
/// 1/metre.
HeightMap height_map(const CoarseView& view, const PlanarRegion& region, double noise,
                     const HeightMapSize& size);

}  // namespace lockbox
