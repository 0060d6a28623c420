// SPDX-License-Identifier: BSD-3-Clause
// What points see of a body: its nearest surface, or the plane that their rays are predicted to
// meet. To be included within Highway's foreach_target: once for each instruction set.
#if defined(LOCKBOX_KERNELS_FIELD_HITS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_FIELD_HITS_INL
#undef LOCKBOX_KERNELS_FIELD_HITS_INL
#else
#define LOCKBOX_KERNELS_FIELD_HITS_INL
#endif

#include "field_look_up-inl.hpp"
#include "hwy/contrib/math/math-inl.h"
#include "lockbox/kernels/point_to_field.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

/// A nearest surface whose outward normal makes less than this angle's cosine with the viewing ray
/// is the far side of the body: what the camera sees there cannot be it. Contours (cosine near 0)
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
                    hn::MulAdd(hn::Set(df, noise.depth_linear), z, hn::Set(df, noise.depth_floor)));
}

/// p, q: the points in the camera's and in the body's frame.
HWY_INLINE Hit hit_at(const FieldView& field, const RigidMotion& motion, const PointNoise& noise,
                      const Float p[3], const Float q[3], const GridPosition& at) {
  const FloatTag df;
  Hit hit;
  for (int axis = 0; axis < 3; ++axis) hit.position[axis] = q[axis];
  hit.inside = at.inside;
  hit.distance = interpolate<true>(field, at, hit.normal);

  const Float p2 = dot(p, p);
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
                 hn::MulAdd(across, lateral2,
                            hn::Set(df, noise.annealing_sigma * noise.annealing_sigma + 1e-10F)));
  const auto far_side =
      hn::And(hn::Gt(hit.along, hn::Zero(df)),
              hn::Gt(along2, hn::Mul(hn::Set(df, kFarSideCosine * kFarSideCosine), p2)));
  hit.inverse_variance =
      hn::IfThenElseZero(hn::AndNot(far_side, at.inside), hn::Div(hn::Set(df, 1.0F), variance));
  return hit;
}

HWY_INLINE Hit hit_of(const FieldView& field, const RigidMotion& motion, const PointNoise& noise,
                      const Float p[3]) {
  Float q[3];
  transform(motion, p, q);
  return hit_at(field, motion, noise, p, q, locate(field, q));
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

/// Whether what lies `off` behind the points on their rays is within their reach.
HWY_INLINE hn::Mask<FloatTag> is_within_reach(const PointNoise& noise, const Float z,
                                              const Float off, const float gate) {
  const FloatTag df;
  const Float depth_sigma = sigma_z(noise, z);
  const Float variance = hn::MulAdd(depth_sigma, depth_sigma,
                                    hn::Set(df, noise.annealing_sigma * noise.annealing_sigma));
  return hn::Lt(hn::Mul(off, off), hn::Mul(hn::Set(df, gate * gate), variance));
}

/// Whether the nearest surface, taken for a plane, passes through the points that lie `off` behind
/// on the rays.
HWY_INLINE hn::Mask<FloatTag> is_same_plane(const Hit& hit, const Float z, const Float off) {
  const FloatTag df;
  const Float missed = hn::MulAdd(hn::Div(off, z), hit.along, hit.distance);
  const Float missed2 = hn::Mul(hn::Mul(missed, missed), hit.inverse_variance);
  const auto explains = hn::Gt(hit.inverse_variance, hn::Zero(df));
  return hn::And(explains, hn::Lt(missed2, hn::Set(df, kSamePlane * kSamePlane)));
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

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
