// SPDX-License-Identifier: BSD-3-Clause
// Planes in a depth image, and which part of the image lies in each.
//
// A plane m.p = 1 has the inverse depth 1/z = m.r along the ray r = (x/z, y/z, 1): in ray
// coordinates a plane is a plane again, and there the noise of a sensor that triangulates is the
// same everywhere. Two parallel planes 18 mm apart stay two, near and far.
#pragma once

#include <cmath>
#include <vector>

#include "sample_grid.hpp"

namespace lockbox {

struct Plane {
  Eigen::Vector3f m;  ///< normal over distance from the camera, 1/metre

  /// How much 1/depth differs from the plane's, 1/metre.
  float residual(const Eigen::Vector3f& ray, float inverse_depth) const {
    return std::abs(inverse_depth - m.dot(ray));
  }
};

inline constexpr std::size_t kMaxPlanes = 8;

/// The largest planes, the largest first; at most kMaxPlanes. noise: standard deviation of 1/depth.
std::vector<Plane> find_planes(const SampleGrid& grid, double noise);

/// Number of the plane nearest to a measurement, -1 if all are farther than tolerance (1/metre).
int nearest_plane(const std::vector<Plane>& planes, const Eigen::Vector3f& ray, float inverse_depth,
                  float tolerance);

/// Returns for each sample the plane that the surface around it lies in, or -1. A surface that only
/// passes through a plane does not count: all measured neighbours have to be in the plane, too.
std::vector<int> surface_planes(const SampleGrid& grid, const std::vector<Plane>& planes,
                                float tolerance);

}  // namespace lockbox
