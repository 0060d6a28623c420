// SPDX-License-Identifier: BSD-3-Clause
#include "contour_rays.hpp"

#include <algorithm>

#include "lockbox/kernels/contour_rays.hpp"
#include "lockbox/sdf/rigid_motion.hpp"

namespace lockbox {
namespace {

/// How far beside a contour the field is asked. At a distance d from an edge tri-linear distances
/// are too large by up to voxel^2 / (8 d), but fine samples reach 20 mm only.
constexpr float kVoxelsAside = 4.0F;
constexpr float kFarthestAside = 0.016F;  // metres

kernels::ViewIntrinsics intrinsics_of(const PinholeCamera& camera) {
  return {{static_cast<float>(camera.fx), static_cast<float>(camera.fy)},
          {static_cast<float>(camera.cx), static_cast<float>(camera.cy)}};
}

}  // namespace

void ContourRays::touch(const SignedDistanceField& field, const Eigen::Isometry3d& T_body_camera,
                        const PinholeCamera& view) {
  if (pixels_.empty()) return;
  lay_out();
  const std::size_t size = pixels_.size();
  const kernels::ViewIntrinsics intrinsics = intrinsics_of(view);
  const kernels::RigidMotion body_from_camera = to_rigid_motion(T_body_camera);
  const auto voxel = static_cast<float>(field.voxel());
  const kernels::ContourAims aims{
      {from(px), from(py), from(pz)}, {from(ox), from(oy), from(oz)}, from(aside)};
  const kernels::TouchPoints touches{{from(tx), from(ty), from(tz)},
                                     {from(nx), from(ny), from(nz)}};
  kernels::aim_beside({{from(u), from(v)}, from(pixel_depth), {from(nu), from(nv)}, size},
                      intrinsics, body_from_camera, {voxel, kVoxelsAside * voxel, kFarthestAside},
                      aims, touches.p);
  kernels::surface_normals(field.view(), {from(tx), from(ty), from(tz), size}, touches.normal);
  float* const direction[3] = {from(dx), from(dy), from(dz)};
  kernels::aim_along_normals(aims, touches.normal, body_from_camera.translation, size, touches.p,
                             direction);
  kernels::touch(field.view(),
                 {body_from_camera.translation, {direction[0], direction[1], direction[2]}, size},
                 touches);
  kernels::look_at_touches(aims, touches, intrinsics, body_from_camera, size,
                           {{from(ax), from(ay), from(az)},
                            from(agreement),
                            {from(at_u), from(at_v)},
                            {from(du), from(dv)},
                            from(depth)});
}

/// What is left of the last lanes repeats the last pixel.
void ContourRays::lay_out() {
  const std::size_t padded = kernels::padded(pixels_.size());
  for (std::vector<float>& array : arrays_) {
    array.resize(std::max(array.size(), padded));
  }
  for (std::size_t i = 0; i < padded; ++i) {
    const ContourPixel& pixel = pixels_[std::min(i, pixels_.size() - 1)];
    arrays_[u][i] = static_cast<float>(pixel.at.u);
    arrays_[v][i] = static_cast<float>(pixel.at.v);
    arrays_[pixel_depth][i] = pixel.depth;
    arrays_[nu][i] = pixel.normal.x();
    arrays_[nv][i] = pixel.normal.y();
  }
}

ContourTouch ContourRays::touch_of(std::size_t pixel) const {
  const auto number = [&](Number n) { return arrays_[n][pixel]; };
  return {{number(tx), number(ty), number(tz)},
          {number(ax), number(ay), number(az)},
          number(agreement),
          {number(at_u), number(at_v)},
          {number(du), number(dv)},
          number(depth)};
}

}  // namespace lockbox
