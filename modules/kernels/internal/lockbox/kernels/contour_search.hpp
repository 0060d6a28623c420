// SPDX-License-Identifier: BSD-3-Clause
// Where a depth image shows the contours of a body (docs/mathematics.md, "E_free").
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// Contour points of one body, arrays with room for a multiple of kLanes. In double precision: a
/// pixel more or less outwards is what the last digits of the contour's place decide.
struct ContourSpan {
  const double* p[3];       ///< metres, body frame
  const double* normal[3];  ///< unit vector across the ray, out of the body
  /// Of 1 / depth of the surface that ends here, relative, per metre along the normal.
  const double* slope;
  const double* steepness;  ///< largest change of its depth a pixel, as a share of it
  const double* rise;       ///< metres that the surface before it comes nearer to the camera
  std::size_t size;
};

/// p_camera = rotation * p_body + translation; rotation row by row.
struct ContourPose {
  double rotation[9];
  double translation[3];
};

/// A measured depth image in metres, row by row, 0 where nothing is known, and its camera.
struct ContourImage {
  const float* depth;
  double focal_length[2];
  double centre[2];
  std::int32_t width;
  std::int32_t height;
};

/// How far contours are sought, and what counts as a step.
struct ContourSearch {
  double depth_floor;         ///< metres; sigma_z(z) = floor + linear z + quadratic z^2
  double depth_quadratic;     ///< 1 / metre
  double lateral_pixels;      ///< standard deviation across the ray
  double annealing_sigma;     ///< metres that the contours may be off
  double gate;                ///< standard deviations that are searched
  double tolerance;           ///< standard deviations along the ray that are no step
  double depth_linear = 0.0;  ///< metres a metre
};

/// By contour point.
struct ContourCorrespondences {
  double* offset;    ///< metres along the normal to where the camera saw the contour
  double* variance;  ///< of that by the sensor's noise, m^2; 0 where nothing was seen of it
};

/// Searches contours. From the contour outwards along its normal the first pixel is sought that
/// shows what lies beyond, and from there inwards the first that shows the surface which ends here;
/// the contour passes between them. If as far as is searched nothing but what lies beyond is seen,
/// the contour is at least most of that way inwards. Nothing is seen where something nearer comes
/// in between, or more than one pixel in a row that was not measured, or the border of the image.
void search_contours(const ContourSpan& points, const ContourPose& camera_from_body,
                     const ContourImage& image, const ContourSearch& search,
                     const ContourCorrespondences& correspondences);

}  // namespace lockbox::kernels
