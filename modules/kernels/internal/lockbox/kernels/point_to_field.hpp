// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the model term: observed points against signed distance fields.
//
// All arrays are structures of arrays over the points of one tile, kLanes-aligned in length,
// floats. Each function exists once, written with Highway, and is compiled for every instruction
// set; the best one that the machine has is chosen at run time.
#pragma once

#include <cstddef>
#include <span>

#include "lockbox/kernels/field_view.hpp"

namespace lockbox::kernels {

/// Lengths of arrays are multiples of this; padding points lie outside every field (kPadding).
inline constexpr std::size_t kLanes = 16;
inline constexpr float kPadding = 1e6F;

/// Rounds up to a multiple of kLanes.
constexpr std::size_t padded(std::size_t count) {
  return (count + kLanes - 1) / kLanes * kLanes;
}

/// Points in the camera's frame, metres.
struct PointSpan {
  const float* x;
  const float* y;
  const float* z;
  std::size_t size;
};

/// p_body = rotation * p_camera + translation; rotation row by row.
struct RigidMotion {
  float rotation[9];
  float translation[3];
};

/// How far a measured point may lie from the surface that it shows: standard deviations.
/// sigma_z(z) = depth_floor + depth_linear z + depth_quadratic z^2 along the ray, lateral z across
/// it.
struct PointNoise {
  float depth_floor;          ///< metres
  float depth_quadratic;      ///< 1 / metre
  float lateral;              ///< metres per metre of depth: pixels / focal length
  float annealing_sigma;      ///< metres: how far off the configuration may still be (annealing)
  float depth_linear = 0.0F;  ///< metres a metre
};

/// What the points of a tile see in one body's field. Arrays of PointSpan::size.
struct FieldHits {
  float* distance;          ///< metres; kPadding off the field, which is beyond any gate
  float* nearest;           ///< the same, to the nearest surface whatever won
  float* normal[3];         ///< gradient of the distance, body frame
  float* position[3];       ///< the point, or q of its plane, body frame
  float* inverse_variance;  ///< of the distance, 1 / m^2; 0 where the body cannot explain the point
};

/// What is predicted for the pixels of points.
struct PredictedPixels {
  const float* body;   ///< number of the body that the pixel shows, or label_beside
  const float* depth;  ///< of its surface there, metres
};

/// Planes fixed to bodies, by point: its distance is normal . q_body + offset, q being where the
/// body was predicted on its ray. (It is q that shows how far a motion of the body carries the
/// plane: noise along the ray must not change the motion scale.)
struct BodyPlanes {
  float* offset;  ///< metres; kNoPlane where there is none
  float* normal[3];
};
inline constexpr float kNoPlane = 1e30F;

/// Distance, gradient and variance of every point. The variance is that of the point along the
/// gradient n: (n.r)^2 sigma_z^2 + (|n|^2 - (n.r)^2 / |r|^2) sigma_lateral^2 + annealing_sigma^2
/// with the ray r = p / z. Points beyond the field, or whose nearest surface faces away from the
/// camera, get inverse_variance 0.
///
/// Noise along the ray is larger than across it, and may carry a point closer to another surface
/// than to the one that it was measured on. Where that is predicted to be this body's, at q on the
/// point's ray within gate standard deviations, the nearest surface competes with the plane there,
/// distance(q) + n(q).(p - q): that of the two wins near which a measurement is more likely. The
/// density of measurements near a surface is that of the noise, thinned as it turns from the
/// camera:
///
///   |n.r| / |r| / sigma exp(-distance^2 / (2 sigma^2)),   0 where n.r > 0.
///
/// Planes that win are written to `planes`, other points are left as they are there. has_planes:
/// whether an earlier body left any; the first ones set all offsets.
///
/// A point that lies more than gate standard deviations, and 50 mm, before what its pixel is
/// predicted to show of the body gets inverse_variance 0, too: something else stands there, however
/// near to another side of the body.
void look_up(const FieldView& field, const RigidMotion& body_from_camera, const PointNoise& noise,
             const PointSpan& points, const PredictedPixels& predicted, float body, float gate,
             const FieldHits& hits, const BodyPlanes& planes, bool& has_planes);

/// The distances under the selection of an earlier look_up: to the body's planes where there are
/// any, to its nearest surface elsewhere.
void frozen_distance(const RigidMotion& body_from_camera, const PointSpan& points,
                     const PredictedPixels& predicted, float body, const BodyPlanes& planes,
                     const float* nearest, float* distance);

/// Only the distances to the nearest surface.
void look_up_distance(const FieldView& field, const RigidMotion& body_from_camera,
                      const PointSpan& points, float* distance);

/// Label of a point in whose pixel no body is predicted: -1 less how far it lies beside the
/// predicted bodies, metres.
constexpr float label_beside(float metres) {
  return -1.0F - metres;
}

/// The bodies that compete for the points of a tile.
struct Candidates {
  std::size_t size;                                ///< points
  std::span<const float* const> distance;          ///< by candidate
  std::span<const float* const> inverse_variance;  ///< by candidate
  std::span<const float> body;                     ///< by candidate: its number
  const float* visible;                            ///< by point: PredictedPixels::body
  const float* averaged_pixels;                    ///< by point: pixels that it is the mean of
  float reach;  ///< metres beside the predicted bodies where points may still be theirs
  float gate;
  float visible_odds;
};

/// The cost of a point: minus the logarithm of a mixture of Gaussians, one a body, and outliers,
///
///   E = -log(e^-c + sum_l odds_l exp(-s_l / 2)),   s_l = distance_l^2 / variance_l,  c = gate^2
///   / 2.
///
/// For a single body it is s / 2 up to about the gate and c beyond it; among several it is their
/// soft minimum, which has no winner among equals. A body that is predicted to be what the point's
/// pixel shows has odds `visible_odds`, others 1: where two bodies meet, both are near, and only
/// visibility tells which one was measured. Points beyond reach have odds 0: no body can be there.
///
/// Returns sum averaged_pixels (E - c) over the points, so that an unexplained point counts zero,
/// and writes weight[l][i] = 2 averaged_pixels dE / d(distance_l^2), its weight in body l's normal
/// equations.
double associate(const Candidates& candidates, std::span<float* const> weight);

/// The cost alone, as associate returns it.
double association_cost(const Candidates& candidates);

/// Sums of one body over points, in the twist (v, w) of the body's own frame: the row of a point is
/// a = -(n, p x n), since a body that moves by xi changes the distance by a . xi.
struct NormalSums {
  double hessian[21];       ///< sum w a a', upper triangle row by row
  double gradient[6];       ///< sum w distance a
  double mass;              ///< sum w
  double first_moment[3];   ///< sum w p
  double second_moment[6];  ///< sum w p p', upper triangle row by row
  double weighted_squares;  ///< sum w distance^2
  double weight;            ///< sum w / inverse_variance: how many points speak for the body
};

/// The sums over one tile; single precision within the tile, so keep tiles small.
NormalSums accumulate(std::size_t size, const FieldHits& hits, const float* weight);

}  // namespace lockbox::kernels
