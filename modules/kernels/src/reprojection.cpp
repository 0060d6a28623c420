// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/reprojection.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reprojection.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "field_look_up-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

constexpr float kBorder = 1e-3F;  // pixels: more than single precision errs

struct Landing {
  Float depth;
  Float measured[3];
  Int pixel;
};

/// Neighbours mostly land on neighbours, which one load reads.
HWY_INLINE Float load_or_gather(const float* values, const Int index) {
  const FloatTag df;
  const IntTag di;
  const std::int32_t first = hn::GetLane(index);
  return hn::AllTrue(di, hn::Eq(index, hn::Iota(di, first))) ? hn::LoadU(df, values + first)
                                                             : hn::GatherIndex(df, values, index);
}

/// p: points in the camera's frame.
HWY_INLINE Landing land_lanes(const MeasuredDepth& image, const Float p[3]) {
  const FloatTag df;
  const IntTag di;
  const Intrinsics& camera = image.camera;
  const Float zero = hn::Zero(df);
  const Float inverse_z = hn::Div(hn::Set(df, 1.0F), p[2]);
  const Float shifted[2] = {
      hn::MulAdd(hn::Mul(hn::Set(df, camera.fx), p[0]), inverse_z, hn::Set(df, camera.cx + 0.5F)),
      hn::MulAdd(hn::Mul(hn::Set(df, camera.fy), p[1]), inverse_z, hn::Set(df, camera.cy + 0.5F))};
  const float size[2] = {static_cast<float>(camera.width), static_cast<float>(camera.height)};
  auto inside = hn::Gt(p[2], zero);
  Float to_border = hn::Set(df, 1.0F);
  Int at[2];
  for (int axis = 0; axis < 2; ++axis) {
    const Float s = shifted[axis];
    const Float bounded = hn::Min(hn::Max(s, hn::Set(df, -0.5F)), hn::Set(df, size[axis] + 0.5F));
    to_border = hn::Min(to_border, hn::Abs(hn::Sub(bounded, hn::Round(bounded))));
    inside = hn::And(inside, hn::And(hn::Ge(s, zero), hn::Lt(s, hn::Set(df, size[axis]))));
    // Whatever the number was: the gather stays in the image.
    const std::int32_t last = axis == 0 ? camera.width - 1 : camera.height - 1;
    at[axis] = hn::Min(hn::Max(hn::ConvertTo(di, bounded), hn::Zero(di)), hn::Set(di, last));
  }
  const auto undecided = hn::Lt(to_border, hn::Set(df, kBorder));
  const Int index = hn::Add(hn::Mul(at[1], hn::Set(di, camera.width)), at[0]);
  const Float measured = hn::IfThenElseZero(inside, load_or_gather(image.depth, index));
  const auto along = [&](const Int coordinate, const float centre, const float focal_length) {
    const Float off = hn::Sub(hn::ConvertTo(df, coordinate), hn::Set(df, centre));
    return hn::Mul(hn::Div(off, hn::Set(df, focal_length)), measured);
  };
  const Int pixel = hn::IfThenElse(hn::RebindMask(di, inside), index, hn::Set(di, kOutside));
  return {p[2],
          {along(at[0], camera.cx, camera.fx), along(at[1], camera.cy, camera.fy), measured},
          hn::IfThenElse(hn::RebindMask(di, undecided), hn::Set(di, kUndecided), pixel)};
}

void land_points(const PointSpan& points, const RigidMotion& camera_from_body,
                 const MeasuredDepth& image, const Landings& result) {
  const FloatTag df;
  const IntTag di;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
    Float moved[3];
    transform(camera_from_body, p, moved);
    const Landing landing = land_lanes(image, moved);
    hn::StoreU(landing.depth, df, result.expected + i);
    hn::StoreU(landing.measured[0], df, result.x + i);
    hn::StoreU(landing.measured[1], df, result.y + i);
    hn::StoreU(landing.measured[2], df, result.measured + i);
    hn::StoreU(landing.pixel, di, result.pixel + i);
  }
}

std::size_t points_in_violation(const Landings& landings, std::size_t size, const PointNoise& noise,
                                float zone, std::uint32_t* result) {
  const FloatTag df;
  const IntTag di;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; i += hn::Lanes(df)) {
    const Float z = hn::LoadU(df, landings.expected + i);
    const Int pixel = hn::LoadU(di, landings.pixel + i);
    const Float sigma =
        hn::MulAdd(hn::Set(df, noise.depth_quadratic), hn::Mul(z, z),
                   hn::MulAdd(hn::Set(df, noise.depth_linear), z, hn::Set(df, noise.depth_floor)));
    const Float behind = hn::Sub(hn::LoadU(df, landings.measured + i), z);
    const auto deeper =
        hn::And(hn::RebindMask(di, hn::Gt(behind, hn::Mul(hn::Set(df, zone), sigma))),
                hn::Gt(pixel, hn::Set(di, -1)));
    auto wanted = hn::Or(deeper, hn::Eq(pixel, hn::Set(di, kUndecided)));
    while (!hn::AllFalse(di, wanted)) {  // few are
      const std::size_t lane = static_cast<std::size_t>(hn::FindFirstTrue(di, wanted));
      if (i + lane < size) {
        result[count++] = static_cast<std::uint32_t>(i + lane);
      }
      wanted =
          hn::AndNot(hn::Eq(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(lane))), wanted);
    }
  }
  return count;
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(land_points);
HWY_EXPORT(points_in_violation);

void land(const PointSpan& points, const RigidMotion& camera_from_body, const MeasuredDepth& image,
          const Landings& result) {
  HWY_DYNAMIC_DISPATCH(land_points)(points, camera_from_body, image, result);
}

std::size_t free_space_violations(const Landings& landings, std::size_t count,
                                  const PointNoise& noise, float zone, std::uint32_t* result) {
  return HWY_DYNAMIC_DISPATCH(points_in_violation)(landings, count, noise, zone, result);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
