// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/kernels/point_to_field.hpp"

#include <array>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "point_to_field.cpp"
#include "hwy/foreach_target.h"
// After foreach_target, which includes this file once for each instruction set.
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "normal_sums-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

/// A nearest surface whose outward normal makes less than this angle's cosine with the viewing ray
/// is the far side of the body: what the camera sees there cannot be it. Outlines (cosine near 0)
/// must stay, for points beyond them pull the body sideways.
constexpr float kFarSideCosine = 0.6F;

constexpr float kSamePlane = 0.5F;  // standard deviations

/// The nearest surface of a body, as points of a vector see it.
struct Hit {
  Float distance;
  Float normal[3];
  Float position[3];          // of the point, body frame
  Float along;                // normal . point, both in the body's axes
  Float inverse_variance;     // 0 where the body cannot explain the point
  hn::Mask<FloatTag> inside;  // the field
};

HWY_INLINE Float sigma_z(const PointNoise& noise, const Float z) {
  const FloatTag df;
  return hn::MulAdd(hn::Set(df, noise.depth_quadratic), hn::Mul(z, z),
                    hn::Set(df, noise.depth_floor));
}

HWY_INLINE Hit hit_of(const FieldView& field, const RigidMotion& motion, const PointNoise& noise,
                      const Float p[3]) {
  const FloatTag df;
  Hit hit;
  transform(motion, p, hit.position);
  const GridPosition at = locate(field, hit.position);
  hit.inside = at.inside;
  hit.distance = interpolate<true>(field, at, hit.normal);

  const Float p2 = dot(p, p);
  const Float* q = hit.position;
  const Float ray[3] = {hn::Sub(q[0], hn::Set(df, motion.translation[0])),
                        hn::Sub(q[1], hn::Set(df, motion.translation[1])),
                        hn::Sub(q[2], hn::Set(df, motion.translation[2]))};
  hit.along = dot(hit.normal, ray);
  const Float along2 = hn::Mul(hit.along, hit.along);
  const Float z2 = hn::Mul(p[2], p[2]);
  const Float depth_sigma = sigma_z(noise, p[2]);
  const Float lateral2 = hn::Mul(hn::Set(df, noise.lateral * noise.lateral), z2);
  const Float across =
      hn::Max(hn::Zero(df), hn::Sub(dot(hit.normal, hit.normal), hn::Div(along2, p2)));
  const Float variance =
      hn::MulAdd(hn::Div(along2, z2), hn::Mul(depth_sigma, depth_sigma),
                 hn::MulAdd(across, lateral2, hn::Set(df, noise.spread * noise.spread + 1e-10F)));
  const auto far_side =
      hn::And(hn::Gt(hit.along, hn::Zero(df)),
              hn::Gt(along2, hn::Mul(hn::Set(df, kFarSideCosine * kFarSideCosine), p2)));
  hit.inverse_variance =
      hn::IfThenElseZero(hn::AndNot(far_side, at.inside), hn::Div(hn::Set(df, 1.0F), variance));
  return hit;
}

/// The squared density of measurements near the surface, but for factors that all surfaces on a ray
/// share. stretch: of the ray up to where the surface was sought.
HWY_INLINE Float density2(const Hit& hit, const Float stretch) {
  const FloatTag df;
  const Float zero = hn::Zero(df);
  const Float facing = hn::Div(hn::Min(hit.along, zero), stretch);
  const Float s = hn::Mul(hn::Mul(hit.distance, hit.distance), hit.inverse_variance);
  return hn::Mul(hn::Mul(hn::Mul(facing, facing), hit.inverse_variance),
                 hn::Exp(df, hn::Max(hn::Neg(s), hn::Set(df, -80.0F))));
}

/// Whether the rays are predicted to meet the body near the points, but not in the nearest surface:
/// that, taken for a plane, would pass through the predicted point.
HWY_INLINE hn::Mask<FloatTag> is_open(const Hit& hit, const PointNoise& noise, const Float z,
                                      const Float predicted, const float cut) {
  const FloatTag df;
  const Float depth_sigma = sigma_z(noise, z);
  const Float variance =
      hn::MulAdd(depth_sigma, depth_sigma, hn::Set(df, noise.spread * noise.spread));
  const Float off = hn::Sub(predicted, z);
  const auto is_near = hn::Lt(hn::Mul(off, off), hn::Mul(hn::Set(df, cut * cut), variance));
  const Float missed = hn::MulAdd(hn::Div(off, z), hit.along, hit.distance);
  const Float missed2 = hn::Mul(hn::Mul(missed, missed), hit.inverse_variance);
  const auto explains = hn::Gt(hit.inverse_variance, hn::Zero(df));
  const auto is_same = hn::And(explains, hn::Lt(missed2, hn::Set(df, kSamePlane * kSamePlane)));
  return hn::AndNot(is_same, is_near);
}

/// Replaces the nearest surface by the planes that the rays meet, where those are more likely.
/// Returns where.
HWY_INLINE hn::Mask<FloatTag> let_rays_compete(const FieldView& field, const RigidMotion& motion,
                                               const PointNoise& noise, const Float p[3],
                                               const Float predicted,
                                               const hn::Mask<FloatTag> competes, Hit& hit) {
  const FloatTag df;
  const Float one = hn::Set(df, 1.0F);
  const Float stretch = hn::IfThenElse(competes, hn::Div(predicted, p[2]), one);
  const Float q[3] = {hn::Mul(stretch, p[0]), hn::Mul(stretch, p[1]), hn::Mul(stretch, p[2])};
  Hit met = hit_of(field, motion, noise, q);
  // From q back to p along the ray.
  met.distance = hn::MulAdd(hn::Div(hn::Sub(one, stretch), stretch), met.along, met.distance);
  const auto wins = hn::And(competes, hn::Gt(density2(met, stretch), density2(hit, one)));
  hit.inside = hn::Or(hit.inside, wins);
  hit.distance = hn::IfThenElse(wins, met.distance, hit.distance);
  hit.inverse_variance = hn::IfThenElse(wins, met.inverse_variance, hit.inverse_variance);
  for (int axis = 0; axis < 3; ++axis) {
    hit.normal[axis] = hn::IfThenElse(wins, met.normal[axis], hit.normal[axis]);
    hit.position[axis] = hn::IfThenElse(wins, met.position[axis], hit.position[axis]);
  }
  return wins;
}

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

bool look_up_points(const FieldView& field, const RigidMotion& motion, const PointNoise& noise,
                    const PointSpan& points, const PredictedPixels& predicted, float body,
                    float cut, const FieldHits& hits, const BodyPlanes& planes) {
  const FloatTag df;
  bool any_won = false;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
    Hit hit = hit_of(field, motion, noise, p);
    hn::StoreU(hn::IfThenElse(hit.inside, hit.distance, hn::Set(df, kPadding)), df,
               hits.nearest + i);
    const Float depth = hn::LoadU(df, predicted.depth + i);
    const auto shows_body = hn::Eq(hn::LoadU(df, predicted.body + i), hn::Set(df, body));
    const auto competes = hn::And(shows_body, is_open(hit, noise, p[2], depth, cut));
    if (!hn::AllFalse(df, competes)) {
      const auto wins = let_rays_compete(field, motion, noise, p, depth, competes, hit);
      store_planes(hit, wins, planes, i);
      any_won = any_won || !hn::AllFalse(df, wins);
    }
    store(hit, hits, i);
  }
  return any_won;
}

void frozen_point_distances(const RigidMotion& motion, const PointSpan& points,
                            const PredictedPixels& predicted, float body, const BodyPlanes& planes,
                            const float* nearest, float* distance) {
  const FloatTag df;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
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
  const FloatTag df;
  for (std::size_t i = 0; i < points.size; i += hn::Lanes(df)) {
    const Float p[3] = {hn::LoadU(df, points.x + i), hn::LoadU(df, points.y + i),
                        hn::LoadU(df, points.z + i)};
    Float q[3];
    transform(motion, p, q);
    const GridPosition at = locate(field, q);
    const Float d = interpolate<false>(field, at, nullptr);
    hn::StoreU(hn::IfThenElse(at.inside, d, hn::Set(df, kPadding)), df, distance + i);
  }
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
  const float outlier_cost = 0.5F * candidates.cut * candidates.cut;
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
    const Float gain = hn::Add(hn::Log(df, sum), c);
    total = hn::Sub(total, gain);
    if constexpr (WithWeights) {
      const Float inverse_sum = hn::Div(one, sum);
      for (std::size_t l = 0; l < candidates.distance.size(); ++l) {
        const Float iv = hn::LoadU(df, candidates.inverse_variance[l] + i);
        const Float w = hn::Mul(hn::LoadU(df, weight[l] + i), hn::Mul(inverse_sum, iv));
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
  Float mass = hn::Zero(df);
  Float first[3] = {mass, mass, mass};
  Float second[6] = {mass, mass, mass, mass, mass, mass};
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
    mass = hn::Add(mass, w);
    for (int row = 0, k = 0; row < 3; ++row) {
      const Float wp = hn::IfThenElseZero(hn::Gt(w, hn::Zero(df)), hn::Mul(w, p[row]));
      first[row] = hn::Add(first[row], wp);
      for (int column = row; column < 3; ++column, ++k) {
        second[k] = hn::MulAdd(wp, p[column], second[k]);
      }
    }
    squares = hn::MulAdd(wd, d, squares);
    const Float iv = hn::LoadU(df, hits.inverse_variance + i);
    count = hn::Add(count, hn::IfThenElseZero(hn::Gt(iv, hn::Zero(df)), hn::Div(w, iv)));
  }
  NormalSums sums{};
  lanes.write(sums);
  sums.mass = sum_of_lanes(mass);
  for (int k = 0; k < 3; ++k) sums.first_moment[k] = sum_of_lanes(first[k]);
  for (int k = 0; k < 6; ++k) sums.second_moment[k] = sum_of_lanes(second[k]);
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

bool look_up(const FieldView& field, const RigidMotion& body_from_camera, const PointNoise& noise,
             const PointSpan& points, const PredictedPixels& predicted, float body, float cut,
             const FieldHits& hits, const BodyPlanes& planes) {
  return HWY_DYNAMIC_DISPATCH(look_up_points)(field, body_from_camera, noise, points, predicted,
                                              body, cut, hits, planes);
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
