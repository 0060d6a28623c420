// SPDX-License-Identifier: BSD-3-Clause
// What the camera sees over a plane, as a map of heights; and where in it a model's relief fits.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "lockbox/core/stop_request.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "model_relief.hpp"
#include "planar_regions.hpp"

namespace lockbox {

/// A way to lay a relief onto a plane.
struct ReliefMatch {
  Eigen::Isometry3d T_camera_body;  ///< of the relief's body
  int score;                        ///< comparable among the matches of one relief
};

/// The best placements of the relief on the region's plane, best first, at most `most`, apart from
/// each other. noise: standard deviation of 1/depth, 1/metre. Throws Stopped if that is requested.
std::vector<ReliefMatch> match_relief(const CoarseView& view, const PlanarRegion& region,
                                      const ModelRelief& relief, double noise, std::size_t most,
                                      const StopRequest& stop_request);

}  // namespace lockbox
