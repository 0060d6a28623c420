// SPDX-License-Identifier: BSD-3-Clause
// What the camera sees over a plane, as a map of heights; and where in it a model's template fits.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "height_template.hpp"
#include "lockbox/core/stop_request.hpp"
#include "lockbox/verification/coarse_view.hpp"
#include "planar_regions.hpp"

namespace lockbox {

/// A way to lay a template onto a plane.
struct TemplateMatch {
  Eigen::Isometry3d T_camera_body;  ///< of the template's body
  int score;                        ///< comparable among the matches of one template
};

/// The best placements of the template on the region's plane, best first, at most `most`, apart
/// from each other. noise: standard deviation of 1/depth, 1/metre. Throws Stopped if that is
/// requested.
std::vector<TemplateMatch> match_template(const CoarseView& view, const PlanarRegion& region,
                                          const HeightTemplate& height_template, double noise,
                                          std::size_t most, const StopRequest& stop_request);

}  // namespace lockbox
