// SPDX-License-Identifier: BSD-3-Clause
// Between the pixels of a view beside which contours of a body pass, and the points where rays
// touch it (ray_touch.hpp): where rays are to pass, and what the points look like in the view.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/kernels/ray_touch.hpp"

namespace lockbox::kernels {

/// What follows is arrays with room for a multiple of kLanes.

/// The pinhole of a view, pixels.
struct ViewIntrinsics {
  float focal_length[2];
  float centre[2];
};

/// Pixels of a view that show a body, beside which a contour of it passes.
struct ContourPixels {
  const float* at[2];
  const float* depth;      ///< metres
  const float* normal[2];  ///< of the contour in the image, out of the body: unit vectors
  std::size_t size;
};

/// By pixel, in the frame of the body.
struct ContourAims {
  float* p[3];         ///< the surface in the pixel, metres
  float* outwards[3];  ///< unit vector across its ray, out of the body
  float* aside;        ///< metres from the surface to where a ray is to pass
};

/// How far beside the surface in a pixel the field is asked, metres: a pixel, and beyond it up to
/// `farthest` in all, but from `least` to `most`.
struct Aside {
  float least;
  float most;
  float farthest;
};

/// Where rays through pixels meet the surface, and a point on a ray beside the contour for each of
/// them, which is written to `beside`.
void aim_beside(const ContourPixels& pixels, const ViewIntrinsics& view,
                const RigidMotion& body_from_camera, const Aside& aside, const ContourAims& aims,
                float* const beside[3]);

/// Aims at the same points once the normals of the surface near them are known, which say better
/// than pixels where outwards is, and the directions of their rays, unit vectors. camera: its place
/// in the frame of the body.
void aim_along_normals(const ContourAims& aims, const float* const normals[3],
                       const float camera[3], std::size_t size, float* const beside[3],
                       float* const direction[3]);

/// What is written of each point where a ray touches the body.
struct ContourLooks {
  float* normal[3];     ///< across the ray, out of the body: unit vector in its frame
  float* agreement;     ///< its cosine with the pixel's, times the sine of surface normal and ray
  float* at[2];         ///< pixels of the view
  float* direction[2];  ///< of the normal in the view, unit vector
  float* depth;         ///< metres
};

/// touches: points and the surface's normals there, in the frame of the body.
void look_at_touches(const ContourAims& aims, const TouchPoints& touches,
                     const ViewIntrinsics& view, const RigidMotion& body_from_camera,
                     std::size_t size, const ContourLooks& looks);

}  // namespace lockbox::kernels
