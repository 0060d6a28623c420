// SPDX-License-Identifier: BSD-3-Clause
// Rays beside one body, aimed past the pixels of a view beside which its contours pass, and where
// they touch it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <vector>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/sdf/signed_distance_field.hpp"
#include "lockbox/view/contour.hpp"

namespace lockbox {

/// A pixel of a view that shows a body, beside which a contour of it passes.
struct ContourPixel {
  Pixel at;
  float depth;  ///< metres
  TangentPlane plane;
  Eigen::Vector2f normal;  ///< of the contour in the image, as far as pixels tell it: unit vector
};

/// A point where a ray touches the body.
struct ContourTouch {
  Eigen::Vector3f p_body;       ///< metres, body frame
  Eigen::Vector3f normal_body;  ///< unit vector across the ray, out of the body
  float agreement;              ///< of the surface's normal with the pixel's: a cosine
  Eigen::Vector2f at;           ///< pixels of the view
  Eigen::Vector2f direction;    ///< of the normal in the view, unit vector
  float depth;                  ///< metres
};

/// Reuses its buffers.
class ContourRays {
 public:
  void clear() { pixels_.clear(); }
  void add(const ContourPixel& pixel) { pixels_.push_back(pixel); }

  /// Touches the body with that field, which the pixels show. First the normals are told by the
  /// field, then the points: rays that were aimed along the normals of whole pixels would pass the
  /// contour at some places more often than at others, and these depend on how pixels lie.
  void touch(const SignedDistanceField& field, const Eigen::Isometry3d& T_body_camera,
             const PinholeCamera& view);

  const std::vector<ContourPixel>& pixels() const { return pixels_; }
  ContourTouch touch_of(std::size_t pixel) const;

 private:
  enum Number {
    u,  // of pixels: where they are, depths, normals
    v,
    pixel_depth,
    nu,
    nv,
    px,  // of aims: surface, outwards, aside
    py,
    pz,
    ox,
    oy,
    oz,
    aside,
    tx,  // of rays: points that they touch, normals there, directions
    ty,
    tz,
    nx,
    ny,
    nz,
    dx,
    dy,
    dz,
    ax,  // of what the camera sees of those points
    ay,
    az,
    agreement,
    at_u,
    at_v,
    du,
    dv,
    depth,
    numbers
  };

  void lay_out();
  float* from(Number number) { return arrays_[number].data(); }

  std::vector<ContourPixel> pixels_;
  std::array<std::vector<float>, numbers> arrays_;
};

}  // namespace lockbox
