// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/reprojection.hpp"

#include <algorithm>

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
  Float measured;
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
HWY_INLINE Landing land(const MeasuredDepth& image, const Float p[3]) {
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
  const Float measured = load_or_gather(image.depth, index);
  const Int pixel = hn::IfThenElse(hn::RebindMask(di, inside), index, hn::Set(di, kOutside));
  return {p[2], hn::IfThenElseZero(inside, measured),
          hn::IfThenElse(hn::RebindMask(di, undecided), hn::Set(di, kUndecided), pixel)};
}

/// One vector of columns from u on; depth and id are those of its lanes.
HWY_INLINE void reproject_lanes(const float* depth, const std::int16_t* id, std::size_t u,
                                std::int32_t row, const Intrinsics& drawn,
                                std::span<const RigidMotion> motion, const MeasuredDepth& image,
                                const Reprojected& result) {
  const FloatTag df;
  const IntTag di;
  const hn::Rebind<std::int16_t, IntTag> di16;
  const Int bodies = hn::PromoteTo(di, hn::LoadU(di16, id));
  auto left = hn::Gt(bodies, hn::Set(di, -1));
  const Float z = hn::IfThenElse(hn::RebindMask(df, left), hn::LoadU(df, depth), hn::Set(df, 1.0F));
  const Float column = hn::ConvertTo(df, hn::Iota(di, static_cast<std::int32_t>(u)));
  const float ray_y = (static_cast<float>(row) - drawn.cy) / drawn.fy;
  const Float ray_x = hn::Mul(hn::Sub(column, hn::Set(df, drawn.cx)), hn::Set(df, 1.0F / drawn.fx));
  const Float p[3] = {hn::Mul(ray_x, z), hn::Mul(hn::Set(df, ray_y), z), z};
  Float expected = hn::Zero(df);
  Float measured = hn::Zero(df);
  Int pixel = hn::Set(di, kOutside);
  while (!hn::AllFalse(di, left)) {  // mostly once: neighbours show the same body
    const std::int16_t body = id[hn::FindFirstTrue(di, left)];
    const auto here = hn::Eq(bodies, hn::Set(di, body));
    Float moved[3];
    transform(motion[static_cast<std::size_t>(body)], p, moved);
    const Landing landing = land(image, moved);
    const auto here_f = hn::RebindMask(df, here);
    expected = hn::IfThenElse(here_f, landing.depth, expected);
    measured = hn::IfThenElse(here_f, landing.measured, measured);
    pixel = hn::IfThenElse(here, landing.pixel, pixel);
    left = hn::AndNot(here, left);
  }
  hn::StoreU(expected, df, result.expected + u);
  hn::StoreU(measured, df, result.measured + u);
  hn::StoreU(pixel, di, result.pixel + u);
}

void reproject_columns(const DrawnRow& row, const Intrinsics& drawn,
                       std::span<const RigidMotion> motion, const MeasuredDepth& image,
                       const Reprojected& result) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t u = 0;
  for (; u + lanes <= row.columns; u += lanes) {
    reproject_lanes(row.depth + u, row.id + u, u, row.row, drawn, motion, image, result);
  }
  if (u < row.columns) {
    float depth[kLanes] = {};
    std::int16_t id[kLanes];
    std::fill_n(id, kLanes, std::int16_t{-1});
    std::copy(row.depth + u, row.depth + row.columns, depth);
    std::copy(row.id + u, row.id + row.columns, id);
    reproject_lanes(depth, id, u, row.row, drawn, motion, image, result);
  }
}

std::size_t columns_seen_through(const Reprojected& row, std::size_t columns,
                                 const PointNoise& noise, float zone, std::uint32_t* result) {
  const FloatTag df;
  const IntTag di;
  std::size_t count = 0;
  for (std::size_t u = 0; u < columns; u += hn::Lanes(df)) {
    const Float z = hn::LoadU(df, row.expected + u);
    const Int pixel = hn::LoadU(di, row.pixel + u);
    const Float sigma = hn::MulAdd(hn::Set(df, noise.depth_quadratic), hn::Mul(z, z),
                                   hn::Set(df, noise.depth_floor));
    const Float behind = hn::Sub(hn::LoadU(df, row.measured + u), z);
    const auto deeper =
        hn::And(hn::RebindMask(di, hn::Gt(behind, hn::Mul(hn::Set(df, zone), sigma))),
                hn::Gt(pixel, hn::Set(di, -1)));
    auto wanted = hn::Or(deeper, hn::Eq(pixel, hn::Set(di, kUndecided)));
    while (!hn::AllFalse(di, wanted)) {  // few are
      const std::size_t lane = static_cast<std::size_t>(hn::FindFirstTrue(di, wanted));
      if (u + lane < columns) {
        result[count++] = static_cast<std::uint32_t>(u + lane);
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

HWY_EXPORT(reproject_columns);
HWY_EXPORT(columns_seen_through);

void reproject(const DrawnRow& row, const Intrinsics& drawn, std::span<const RigidMotion> motion,
               const MeasuredDepth& image, const Reprojected& result) {
  HWY_DYNAMIC_DISPATCH(reproject_columns)(row, drawn, motion, image, result);
}

std::size_t seen_through(const Reprojected& row, std::size_t columns, const PointNoise& noise,
                         float zone, std::uint32_t* result) {
  return HWY_DYNAMIC_DISPATCH(columns_seen_through)(row, columns, noise, zone, result);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
