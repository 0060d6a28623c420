// SPDX-License-Identifier: BSD-3-Clause
// Which measured points lie how near to which body: what PCL calls correspondences.
#pragma once

#include <vector>

#include "lockbox/cloud/point_tiles.hpp"
#include "lockbox/model/articulated_model.hpp"

namespace lockbox {

struct SurfacePair {
  std::uint32_t point;     ///< PointTiles::pixel() of the measured point
  std::size_t body;        ///< whose surface is nearest
  Eigen::Vector3f p_body;  ///< the measured point in its frame
  float squared_distance;  ///< to its surface, m^2
};

/// Returns an even selection of the points in tiles near the model, at most max_pairs, without
/// those that lie farther than reach (metres) from every body.
std::vector<SurfacePair> surface_pairs(const ArticulatedModel& model,
                                       const std::vector<Eigen::Isometry3d>& T_camera_body,
                                       const PointTiles& points, double reach,
                                       std::size_t max_pairs);

}  // namespace lockbox
