// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/point_to_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "point_to_field.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "field_hits-inl.hpp"
#include "normal_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

// Metres that something else stands before a body. The edge of one of its own grooves may be nearer
// than the groove that a pixel beside it is predicted to show.
constexpr float kClearlyBefore = 0.05F;

HWY_INLINE void store(const Hit& hit, const FieldHits& hits, std::size_t i) {
  const FloatTag df;
  hn::StoreU(hn::IfThenElse(hit.inside, hit.distance, hn::Set(df, kPadding)), df,
             hits.distance + i);
  for (int axis = 0; axis < 3; ++axis) {
    hn::StoreU(hit.normal[axis], df, hits.normal[axis] + i);
    hn::StoreU(hit.position[axis], df, hits.position[axis] + i);
  }
  hn::StoreU(hit.inverse_variance, df, hits.inverse_variance + i);
}

HWY_INLINE void store_planes(const Hit& hit, const hn::Mask<FloatTag> where,
                             const BodyPlanes& planes, std::size_t i) {
  const FloatTag df;
  const Float offset = hn::Sub(hit.distance, dot(hit.normal, hit.position));
  hn::StoreU(hn::IfThenElse(where, offset, hn::LoadU(df, planes.offset + i)), df,
             planes.offset + i);
  for (int axis = 0; axis < 3; ++axis) {
    float* const normal = planes.normal[axis] + i;
    hn::StoreU(hn::IfThenElse(where, hit.normal[axis], hn::LoadU(df, normal)), df, normal);
  }
}

void look_up_points(const FieldView& field, const RigidMotion& motion, const PointNoise& noise,
                    const PointSpan& points, const PredictedPixels& predicted, float body,
                    float gate, const FieldHits& hits, const BodyPlanes& planes, bool& has_planes) {
  const FloatTag df;
  const auto place = [&](std::size_t i, Float q[3]) HWY_ATTR {
    Float p[3];
    load(points, i, p);
    transform(motion, p, q);
  };
  const auto visit = [&](std::size_t i, const Float q[3], const GridPosition& at) HWY_ATTR {
    Float p[3];
    load(points, i, p);
    Hit hit = hit_at(field, motion, noise, p, q, at);
    hn::StoreU(hn::IfThenElse(hit.inside, hit.distance, hn::Set(df, kPadding)), df,
               hits.nearest + i);
    const Float depth = hn::LoadU(df, predicted.depth + i);
    const Float off = hn::Sub(depth, p[2]);
    const auto shows_body = hn::Eq(hn::LoadU(df, predicted.body + i), hn::Set(df, body));
    const auto is_near = is_within_reach(noise, p[2], off, gate);
    const auto stands_before = hn::AndNot(is_near, hn::Gt(off, hn::Set(df, kClearlyBefore)));
    hit.inverse_variance =
        hn::IfThenZeroElse(hn::And(shows_body, stands_before), hit.inverse_variance);
    const auto competes = hn::And(shows_body, hn::AndNot(is_same_plane(hit, p[2], off), is_near));
    if (!hn::AllFalse(df, competes)) {
      const auto wins = let_rays_compete(field, motion, noise, p, depth, competes, hit);
      if (!hn::AllFalse(df, wins)) {
        if (!has_planes) std::fill_n(planes.offset, points.size, kNoPlane);
        has_planes = true;
        store_planes(hit, wins, planes, i);
      }
    }
    store(hit, hits, i);
  };
  for_located(field, points.size, place, visit);
}

void frozen_point_distances(const RigidMotion& motion, const PointSpan& points,
                            const PredictedPixels& predicted, float body, const BodyPlanes& planes,
                            const float* nearest, float* distance) {
  const FloatTag df;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    Float p[3];
    load(points, i, p);
    const Float normal[3] = {hn::LoadU(df, planes.normal[0] + i),
                             hn::LoadU(df, planes.normal[1] + i),
                             hn::LoadU(df, planes.normal[2] + i)};
    const Float offset = hn::LoadU(df, planes.offset + i);
    const auto shows_body = hn::Eq(hn::LoadU(df, predicted.body + i), hn::Set(df, body));
    const auto has_plane = hn::And(shows_body, hn::Lt(offset, hn::Set(df, kNoPlane)));
    const Float stretch = hn::Div(hn::LoadU(df, predicted.depth + i), p[2]);
    const Float on_plane[3] = {hn::Mul(stretch, p[0]), hn::Mul(stretch, p[1]),
                               hn::Mul(stretch, p[2])};
    Float q[3];
    transform(motion, on_plane, q);
    hn::StoreU(
        hn::IfThenElse(has_plane, hn::Add(dot(normal, q), offset), hn::LoadU(df, nearest + i)), df,
        distance + i);
  }
}

void look_up_point_distances(const FieldView& field, const RigidMotion& motion,
                             const PointSpan& points, float* distance) {
  const auto place = [&](std::size_t i, Float q[3]) HWY_ATTR {
    Float p[3];
    load(points, i, p);
    transform(motion, p, q);
  };
  const auto visit = [&](std::size_t i, const Float /*q*/[3], const GridPosition& at) HWY_ATTR {
    const FloatTag df;
    const Float d = interpolate<false>(field, at, nullptr);
    hn::StoreU(hn::IfThenElse(at.inside, d, hn::Set(df, kPadding)), df, distance + i);
  };
  for_located(field, points.size, place, visit);
}

/// exp(-s / 2) with s = distance^2 / variance; 0 where the body explains nothing.
HWY_INLINE Float likelihood(const Float distance, const Float inverse_variance) {
  const FloatTag df;
  const Float half =
      hn::Mul(hn::Set(df, -0.5F), hn::Mul(hn::Mul(distance, distance), inverse_variance));
  const Float bounded = hn::Max(half, hn::Set(df, -80.0F));  // exp of less is no float
  return hn::IfThenElseZero(hn::Gt(inverse_variance, hn::Zero(df)), hn::Exp(df, bounded));
}

template <bool WithWeights>
double associate_points_with(const Candidates& candidates, std::span<float* const> weight) {
  const FloatTag df;
  const float outlier_cost = 0.5F * candidates.gate * candidates.gate;
  const Float c = hn::Set(df, outlier_cost);
  const Float outlier = hn::Set(df, std::exp(-outlier_cost));
  const Float one = hn::Set(df, 1.0F);
  const Float visible_odds = hn::Set(df, candidates.visible_odds);
  const Float farthest = hn::Set(df, label_beside(candidates.reach));
  Float total = hn::Zero(df);
  for (std::size_t i = 0; i < candidates.size; i += hn::Lanes(df)) {
    const Float visible = hn::LoadU(df, candidates.visible + i);
    const Float other_odds = hn::IfThenElseZero(hn::Ge(visible, farthest), one);
    Float sum = outlier;
    for (std::size_t l = 0; l < candidates.distance.size(); ++l) {
      const Float odds = hn::IfThenElse(hn::Eq(visible, hn::Set(df, candidates.body[l])),
                                        visible_odds, other_odds);
      const Float share =
          hn::Mul(odds, likelihood(hn::LoadU(df, candidates.distance[l] + i),
                                   hn::LoadU(df, candidates.inverse_variance[l] + i)));
      sum = hn::Add(sum, share);
      if constexpr (WithWeights) {
        hn::StoreU(share, df, weight[l] + i);
      }
    }
    const Float averaged_pixels = hn::LoadU(df, candidates.averaged_pixels + i);
    const Float gain = hn::Add(hn::Log(df, sum), c);
    total = hn::NegMulAdd(averaged_pixels, gain, total);
    if constexpr (WithWeights) {
      const Float share_of_sum = hn::Div(averaged_pixels, sum);
      for (std::size_t l = 0; l < candidates.distance.size(); ++l) {
        const Float iv = hn::LoadU(df, candidates.inverse_variance[l] + i);
        const Float w = hn::Mul(hn::LoadU(df, weight[l] + i), hn::Mul(share_of_sum, iv));
        hn::StoreU(w, df, weight[l] + i);
      }
    }
  }
  return sum_of_lanes(total);
}

double associate_points(const Candidates& candidates, std::span<float* const> weight) {
  return associate_points_with<true>(candidates, weight);
}

double total_association_cost(const Candidates& candidates) {
  return associate_points_with<false>(candidates, {});
}

NormalSums accumulate_points(std::size_t size, const FieldHits& hits, const float* weight) {
  const FloatTag df;
  NormalSumLanes lanes;
  lanes.set_zero();
  Float squares = hn::Zero(df);
  Float count = hn::Zero(df);
  MomentLanes moments;
  moments.set_zero();
  for (std::size_t i = 0; i < size; i += hn::Lanes(df)) {
    const Float w = hn::LoadU(df, weight + i);
    const Float d = hn::LoadU(df, hits.distance + i);
    Float p[3];
    Float n[3];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = hn::LoadU(df, hits.position[axis] + i);
      n[axis] = hn::LoadU(df, hits.normal[axis] + i);
    }
    const Float wd = hn::IfThenElseZero(hn::Gt(w, hn::Zero(df)), hn::Mul(w, d));
    lanes.add(p, n, w, wd);
    moments.add(p, w);
    squares = hn::MulAdd(wd, d, squares);
    const Float iv = hn::LoadU(df, hits.inverse_variance + i);
    count = hn::Add(count, hn::IfThenElseZero(hn::Gt(iv, hn::Zero(df)), hn::Div(w, iv)));
  }
  NormalSums sums{};
  lanes.write(sums);
  moments.write(sums);
  sums.weighted_squares = sum_of_lanes(squares);
  sums.weight = sum_of_lanes(count);
  return sums;
}

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockbox::kernels {

HWY_EXPORT(look_up_points);
HWY_EXPORT(frozen_point_distances);
HWY_EXPORT(look_up_point_distances);
HWY_EXPORT(associate_points);
HWY_EXPORT(total_association_cost);
HWY_EXPORT(accumulate_points);

void look_up(const FieldView& field, const RigidMotion& body_from_camera, const PointNoise& noise,
             const PointSpan& points, const PredictedPixels& predicted, float body, float gate,
             const FieldHits& hits, const BodyPlanes& planes, bool& has_planes) {
  HWY_DYNAMIC_DISPATCH(look_up_points)
  (field, body_from_camera, noise, points, predicted, body, gate, hits, planes, has_planes);
}

void frozen_distance(const RigidMotion& body_from_camera, const PointSpan& points,
                     const PredictedPixels& predicted, float body, const BodyPlanes& planes,
                     const float* nearest, float* distance) {
  HWY_DYNAMIC_DISPATCH(frozen_point_distances)
  (body_from_camera, points, predicted, body, planes, nearest, distance);
}

void look_up_distance(const FieldView& field, const RigidMotion& body_from_camera,
                      const PointSpan& points, float* distance) {
  HWY_DYNAMIC_DISPATCH(look_up_point_distances)(field, body_from_camera, points, distance);
}

double associate(const Candidates& candidates, std::span<float* const> weight) {
  return HWY_DYNAMIC_DISPATCH(associate_points)(candidates, weight);
}

double association_cost(const Candidates& candidates) {
  return HWY_DYNAMIC_DISPATCH(total_association_cost)(candidates);
}

NormalSums accumulate(std::size_t size, const FieldHits& hits, const float* weight) {
  return HWY_DYNAMIC_DISPATCH(accumulate_points)(size, hits, weight);
}

}  // namespace lockbox::kernels
#endif  // HWY_ONCE
