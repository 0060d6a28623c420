// SPDX-License-Identifier: BSD-3-Clause
// Where rays that pass close beside a body touch it: points of its contour.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// From one camera, in the frame of a body.
struct RaySpan {
  const float* origin;        ///< of all of them, x y z, metres
  const float* direction[3];  ///< by ray, unit vectors
  std::size_t size;           ///< arrays have room for a multiple of kLanes
};

/// By ray, in the frame of the body.
struct TouchPoints {
  float* p[3];       ///< metres
  float* normal[3];  ///< outwards, unit vectors
};

/// Finds where each ray comes nearest to the body's surface, starting from the points p on the rays
/// (which the result replaces), by alternating projections onto surface and ray; and goes on from
/// there in the ray's direction while the surface does, for a side that is turned to the camera
/// ends at its far edge.
void touch(const FieldView& field, const RaySpan& rays, const TouchPoints& result);

/// Writes the outward normals, unit vectors, of the surface nearest to points in the body's frame.
void surface_normals(const FieldView& field, const PointSpan& points, float* const normal[3]);

}  // namespace lockbox::kernels
