// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the free-space term: points of a body and targets along fixed
// directions.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include <cstddef>
#include <span>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox::kernels {

/// Correspondences of one body: residual = direction . (camera_from_body p - target). As many as
/// the widest vector holds can be read from the last one on; they have a variance, too.
struct CorrespondenceSpan {
  const float* p[3];                ///< body frame, metres
  const float* target[3];           ///< camera frame, metres
  const float* direction[3];        ///< unit vectors, camera frame
  const float* variance;            ///< of the residual by noise, m^2
  const float* direction_variance;  ///< squared radians
  const float* pixels;              ///< that a correspondence stands for
  std::size_t size;
};

/// What is assumed of residuals: Gaussian, with so much more variance (m^2) than by noise, or
/// outliers beyond so many standard deviations.
struct CorrespondenceLoss {
  float annealing_variance;
  float gate;
};

struct CorrespondenceSums {
  /// Weighted by how likely each correspondence is to be no outlier. Rows are a = (n, p x n) with n
  /// the direction in the body's frame. mass and moments are weighted by direction_variance, too:
  /// for the curvature that wrong directions could feign. Not summed: weighted_squares, weight.
  NormalSums normal;
  double cost;  ///< see correspondence_cost
};

CorrespondenceSums accumulate_correspondences(const CorrespondenceSpan& correspondences,
                                              const RigidMotion& camera_from_body,
                                              const CorrespondenceLoss& loss);

/// Of some correspondences: sum w b b', with w and a as above and b = (a, residual, 0). Their
/// hessian, and as the seventh row their gradient.
struct CorrespondenceProducts {
  float rows[7][8];
};

inline constexpr std::size_t kMostCorrespondences =
    256;  ///< whose products are asked for at a time

/// Writes the products of runs of correspondences, each of which ends where the next one begins. In
/// few sums, so that many short runs take no longer than a long one. correspondences:
/// kMostCorrespondences at most.
void multiply_runs(const CorrespondenceSpan& correspondences, const RigidMotion& camera_from_body,
                   const CorrespondenceLoss& loss, std::span<const std::size_t> ends,
                   CorrespondenceProducts* products);

/// sum pixels (E - c) with E and c as in `associate`, for a single body.
double correspondence_cost(const CorrespondenceSpan& correspondences,
                           const RigidMotion& camera_from_body, const CorrespondenceLoss& loss);

}  // namespace lockbox::kernels
