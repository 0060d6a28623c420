// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/ray_touch.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ray_touch.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "field_look_up-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

constexpr int kProjections = 4;
constexpr int kMostSteps = 20;
constexpr float kStep = 0.004F;  // metres

/// Where the surface comes nearest to points, and how far that is.
struct Nearest {
  Float p[3];
  Float normal[3];
  Float distance;
};

HWY_INLINE Nearest nearest_at(const FieldView& field, const Float p[3], const GridPosition& at) {
  const FloatTag df;
  Nearest result;
  Float gradient[3];
  result.distance = interpolate<true>(field, at, gradient);
  const Float length2 = hn::Max(dot(gradient, gradient), hn::Set(df, 1e-12F));
  const Float scale = hn::Div(hn::Set(df, 1.0F), hn::Sqrt(length2));
  for (int axis = 0; axis < 3; ++axis) {
    result.normal[axis] = hn::Mul(scale, gradient[axis]);
    result.p[axis] = hn::NegMulAdd(result.distance, result.normal[axis], p[axis]);
  }
  return result;
}

HWY_INLINE Nearest nearest(const FieldView& field, const Float p[3]) {
  return nearest_at(field, p, locate(field, p));
}

HWY_INLINE void store(const Nearest& at, const TouchPoints& points, const std::size_t i) {
  store(at.p, points.p, i);
  store(at.normal, points.normal, i);
}

struct Rays {
  Float origin[3];
  Float direction[3];
};

/// Where the rays come nearest to a point, or so much farther from the camera, metres.
HWY_INLINE void onto_rays(const Rays& rays, const Float point[3], const float farther,
                          Float result[3]) {
  Float from_origin[3];
  for (int axis = 0; axis < 3; ++axis) {
    from_origin[axis] = hn::Sub(point[axis], rays.origin[axis]);
  }
  const Float way = hn::Add(dot(rays.direction, from_origin), hn::Set(FloatTag(), farther));
  for (int axis = 0; axis < 3; ++axis) {
    result[axis] = hn::MulAdd(way, rays.direction[axis], rays.origin[axis]);
  }
}

HWY_INLINE void replace(const hn::Mask<FloatTag> where, const Nearest& by, Nearest& at) {
  for (int axis = 0; axis < 3; ++axis) {
    at.p[axis] = hn::IfThenElse(where, by.p[axis], at.p[axis]);
    at.normal[axis] = hn::IfThenElse(where, by.normal[axis], at.normal[axis]);
  }
}

HWY_INLINE Rays rays_at(const RaySpan& span, const std::size_t i) {
  Rays rays;
  for (int axis = 0; axis < 3; ++axis) rays.origin[axis] = hn::Set(FloatTag(), span.origin[axis]);
  load(span.direction, i, rays.direction);
  return rays;
}

/// Where the surface comes nearest to rays, by alternating projections. nearest: points on the rays
/// at first.
HWY_INLINE void come_nearest(const FieldView& field, const RaySpan& rays,
                             const TouchPoints& nearest) {
  for (int k = 0; k < kProjections; ++k) {
    const auto place = [&](std::size_t i, Float p[3]) HWY_ATTR {
      load(nearest.p, i, p);
      if (k > 0) onto_rays(rays_at(rays, i), p, 0.0F, p);
    };
    const auto visit = [&](std::size_t i, const Float p[3], const GridPosition& at)
                           HWY_ATTR { store(nearest_at(field, p, at), nearest, i); };
    for_located(field, rays.size, place, visit);
  }
}

/// Slides back along a side that is turned to the camera: steps along the ray lead into the body,
/// and back onto its surface, until the side ends. From there on the edge is what is nearest to the
/// ray.
HWY_INLINE void slide_back(const FieldView& field, const Rays& rays, Nearest& at) {
  const FloatTag df;
  auto goes_on = hn::Eq(hn::Zero(df), hn::Zero(df));
  auto has_slid = hn::Not(goes_on);
  for (int k = 0; k < kMostSteps; ++k) {
    Float p[3];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = hn::MulAdd(hn::Set(df, kStep), rays.direction[axis], at.p[axis]);
    }
    const Nearest behind = nearest(field, p);
    goes_on = hn::And(goes_on, hn::Lt(behind.distance, hn::Zero(df)));
    if (hn::AllFalse(df, goes_on)) break;
    replace(goes_on, behind, at);
    has_slid = hn::Or(has_slid, goes_on);
  }
  if (hn::AllFalse(df, has_slid)) return;
  Float p[3];
  onto_rays(rays, at.p, kStep, p);
  replace(has_slid, nearest(field, p), at);
}

void touch_rays(const FieldView& field, const RaySpan& rays, const TouchPoints& result) {
  come_nearest(field, rays, result);
  for (std::size_t i = 0; i < rays.size; i += hn::Lanes(FloatTag())) {
    Nearest at;
    load(result.p, i, at.p);
    load(result.normal, i, at.normal);
    slide_back(field, rays_at(rays, i), at);
    store(at, result, i);
  }
}

void normals_at_points(const FieldView& field, const PointSpan& points, float* const normal[3]) {
  const auto place = [&](std::size_t i, Float p[3]) HWY_ATTR { load(points, i, p); };
  const auto visit = [&](std::size_t i, const Float p[3], const GridPosition& at)
                         HWY_ATTR { store(nearest_at(field, p, at).normal, normal, i); };
  for_located(field, points.size, place, visit);
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(touch_rays);
HWY_EXPORT(normals_at_points);

void touch(const FieldView& field, const RaySpan& rays, const TouchPoints& result) {
  HWY_DYNAMIC_DISPATCH(touch_rays)(field, rays, result);
}

void surface_normals(const FieldView& field, const PointSpan& points, float* const normal[3]) {
  HWY_DYNAMIC_DISPATCH(normals_at_points)(field, points, normal);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
