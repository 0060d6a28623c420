// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/contour_rays.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contour_rays.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "vectors-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

constexpr float kNoOffset[3] = {0.0F, 0.0F, 0.0F};

HWY_INLINE Float constant(const float value) {
  return hn::Set(FloatTag(), value);
}

/// Returns 1 / length of a vector that is not zero.
HWY_INLINE Float inverse_length(const Float squared) {
  return hn::Div(constant(1.0F), hn::Sqrt(hn::Max(squared, constant(1e-12F))));
}

HWY_INLINE void scale(const Float factor, Float v[3]) {
  for (int axis = 0; axis < 3; ++axis) v[axis] = hn::Mul(factor, v[axis]);
}

/// The part of a vector that is orthogonal to a ray.
HWY_INLINE void across(const Float ray[3], const Float v[3], Float result[3]) {
  const Float along = hn::Div(dot(ray, v), dot(ray, ray));
  for (int axis = 0; axis < 3; ++axis) result[axis] = hn::NegMulAdd(along, ray[axis], v[axis]);
}

void aim_beside_pixels(const ContourPixels& pixels, const ViewIntrinsics& view,
                       const RigidMotion& body_from_camera, const Aside& aside,
                       const ContourAims& aims, float* const beside[3]) {
  const FloatTag df;
  for (std::size_t i = 0; i < pixels.size; i += hn::Lanes(df)) {
    const Float depth = hn::LoadU(df, pixels.depth + i);
    Float ray[3] = {hn::Zero(df), hn::Zero(df), constant(1.0F)};
    Float normal[3] = {hn::Zero(df), hn::Zero(df), hn::Zero(df)};
    for (int axis = 0; axis < 2; ++axis) {
      const Float per_pixel = constant(1.0F / view.focal_length[axis]);
      const Float off = hn::Sub(hn::LoadU(df, pixels.at[axis] + i), constant(view.centre[axis]));
      ray[axis] = hn::Mul(off, per_pixel);
      normal[axis] = hn::Mul(hn::LoadU(df, pixels.normal[axis] + i), per_pixel);
    }
    Float in_camera[3];
    across(ray, normal, in_camera);
    scale(inverse_length(dot(in_camera, in_camera)), in_camera);
    scale(depth, ray);
    Float p[3];
    Float outwards[3];
    transform(body_from_camera, ray, p);
    rotate(body_from_camera, in_camera, kNoOffset, outwards);
    const Float pixel = hn::Mul(depth, constant(1.0F / view.focal_length[0]));
    const Float way = hn::Add(
        pixel, hn::Min(hn::Max(hn::Sub(constant(aside.farthest), pixel), constant(aside.least)),
                       constant(aside.most)));
    store(p, aims.p, i);
    store(outwards, aims.outwards, i);
    hn::StoreU(way, df, aims.aside + i);
    for (int axis = 0; axis < 3; ++axis) p[axis] = hn::MulAdd(way, outwards[axis], p[axis]);
    store(p, beside, i);
  }
}

void aim_along_surface_normals(const ContourAims& aims, const float* const normals[3],
                               const float camera[3], std::size_t size, float* const beside[3],
                               float* const direction[3]) {
  const FloatTag df;
  for (std::size_t i = 0; i < size; i += hn::Lanes(df)) {
    Float p[3];
    Float normal[3];
    load(aims.p, i, p);
    load(normals, i, normal);
    Float ray[3];
    for (int axis = 0; axis < 3; ++axis) ray[axis] = hn::Sub(p[axis], constant(camera[axis]));
    Float outwards[3];
    across(ray, normal, outwards);
    const Float way =
        hn::Mul(hn::LoadU(df, aims.aside + i), inverse_length(dot(outwards, outwards)));
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = hn::MulAdd(way, outwards[axis], p[axis]);
      ray[axis] = hn::Sub(p[axis], constant(camera[axis]));
    }
    store(p, beside, i);
    scale(inverse_length(dot(ray, ray)), ray);
    store(ray, direction, i);
  }
}

void look_at_touch_points(const ContourAims& aims, const TouchPoints& touches,
                          const ViewIntrinsics& view, const RigidMotion& body_from_camera,
                          std::size_t size, const ContourLooks& looks) {
  const FloatTag df;
  for (std::size_t i = 0; i < size; i += hn::Lanes(df)) {
    Float ray[3];
    Float normal[3];
    Float pixel_outwards[3];
    load(touches.p, i, ray);
    load(touches.normal, i, normal);
    load(aims.outwards, i, pixel_outwards);
    for (int axis = 0; axis < 3; ++axis) {
      ray[axis] = hn::Sub(ray[axis], constant(body_from_camera.translation[axis]));
    }
    Float outwards[3];
    across(ray, normal, outwards);
    hn::StoreU(dot(outwards, pixel_outwards), df, looks.agreement + i);
    Float p[3];
    Float direction[3];
    rotate_back(body_from_camera, ray, p);
    rotate_back(body_from_camera, outwards, direction);
    scale(inverse_length(dot(outwards, outwards)), outwards);
    store(outwards, looks.normal, i);
    hn::StoreU(p[2], df, looks.depth + i);
    const Float per_depth = hn::Div(constant(1.0F), p[2]);
    const Float in_image =
        inverse_length(hn::MulAdd(direction[0], direction[0], hn::Mul(direction[1], direction[1])));
    for (int axis = 0; axis < 2; ++axis) {
      const Float at = hn::MulAdd(constant(view.focal_length[axis]), hn::Mul(p[axis], per_depth),
                                  constant(view.centre[axis]));
      hn::StoreU(at, df, looks.at[axis] + i);
      hn::StoreU(hn::Mul(in_image, direction[axis]), df, looks.direction[axis] + i);
    }
  }
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(aim_beside_pixels);
HWY_EXPORT(aim_along_surface_normals);
HWY_EXPORT(look_at_touch_points);

void aim_beside(const ContourPixels& pixels, const ViewIntrinsics& view,
                const RigidMotion& body_from_camera, const Aside& aside, const ContourAims& aims,
                float* const beside[3]) {
  HWY_DYNAMIC_DISPATCH(aim_beside_pixels)(pixels, view, body_from_camera, aside, aims, beside);
}

void aim_along_normals(const ContourAims& aims, const float* const normals[3],
                       const float camera[3], std::size_t size, float* const beside[3],
                       float* const direction[3]) {
  HWY_DYNAMIC_DISPATCH(aim_along_surface_normals)(aims, normals, camera, size, beside, direction);
}

void look_at_touches(const ContourAims& aims, const TouchPoints& touches,
                     const ViewIntrinsics& view, const RigidMotion& body_from_camera,
                     std::size_t size, const ContourLooks& looks) {
  HWY_DYNAMIC_DISPATCH(look_at_touch_points)(aims, touches, view, body_from_camera, size, looks);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
