// SPDX-License-Identifier: BSD-3-Clause
// Where on a plane of the view a model's template fits.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "height_map.hpp"
#include "height_template.hpp"
#include "lockbox/core/stop_request.hpp"

namespace lockbox {

/// A way to lay a template onto a plane.
struct TemplateMatch {
  Eigen::Isometry3d T_camera_body;  ///< of the template's body
  int score;                        ///< comparable among the matches of one template
};

/// Returns the size of maps onto which all of these, at least one, can be laid.
HeightMapSize map_size(const std::vector<HeightTemplate>& templates);

/// The best placements of the template on the map's plane, best first, at most `most`, apart from
/// each other. Throws Stopped if that is requested.
std::vector<TemplateMatch> match_template(const HeightMap& map,
                                          const HeightTemplate& height_template, std::size_t most,
                                          const StopRequest& stop_request);

}  // namespace lockbox
