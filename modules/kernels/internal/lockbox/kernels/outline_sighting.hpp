// SPDX-License-Identifier: BSD-3-Clause
// Where a depth image shows the outlines of a body (docs/mathematics.md, "Outlines").
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// Outline points of one body, arrays with room for a multiple of kLanes. In double precision: a
/// pixel more or less outwards is what the last digits of the outline's place decide.
struct OutlineSpan {
  const double* p[3];       ///< metres, body frame
  const double* normal[3];  ///< unit vector across the ray, out of the body
  /// Of 1 / depth of the surface that ends here, relative, per metre along the normal.
  const double* slope;
  const double* steepness;  ///< largest change of its depth a pixel, as a share of it
  const double* rise;       ///< metres that the surface before it comes nearer to the camera
  std::size_t size;
};

/// p_camera = rotation * p_body + translation; rotation row by row.
struct OutlinePose {
  double rotation[9];
  double translation[3];
};

/// A measured depth image in metres, row by row, 0 where nothing is known, and its camera.
struct OutlineImage {
  const float* depth;
  double focal_length[2];
  double centre[2];
  std::int32_t width;
  std::int32_t height;
};

/// How far outlines are sought, and what counts as a step.
struct OutlineSearch {
  double depth_floor;         ///< metres; sigma_z(z) = floor + linear z + quadratic z^2
  double depth_quadratic;     ///< 1 / metre
  double lateral_pixels;      ///< standard deviation across the ray
  double spread;              ///< metres that the outlines may be off
  double cut;                 ///< standard deviations that are searched
  double tolerance;           ///< standard deviations along the ray that are no step
  double depth_linear = 0.0;  ///< metres a metre
};

/// By outline point.
struct OutlineSightings {
  double* offset;    ///< metres along the normal to where the camera saw the outline
  double* variance;  ///< of that by the sensor's noise, m^2; 0 where nothing was seen of it
};

/// From the outline outwards along its normal the first pixel is sought that shows what lies
/// beyond, and from there inwards the first that shows the surface which ends here; the outline
/// passes between them. If as far as is searched nothing but what lies beyond is seen, the outline
/// is at least most of that way inwards. Nothing is seen where something nearer comes in between,
/// or more than one pixel in a row that was not measured, or the border of the image.
void sight_outlines(const OutlineSpan& points, const OutlinePose& camera_from_body,
                    const OutlineImage& image, const OutlineSearch& search,
                    const OutlineSightings& sightings);

}  // namespace lockbox::kernels
