// SPDX-License-Identifier: BSD-3-Clause
#include "penetration.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

/// A surface that looks the way the sample itself looks lies on the far side of a thin body. Unit:
/// cosine of the angle between their normals. Source: not recorded. Doubled, surfaces that lie
/// oblique to the sample are taken for the near side.
constexpr float kFarSideCosine = 0.2F;
/// Steps along the normal, at most. Source: not recorded. Doubled, a way along a surface that comes
/// no nearer is followed for longer.
constexpr int kMaxTraceSteps = 200;
constexpr float kSurfaceTolerance = 2e-6F;  // metres

/// The way back along the sample's own normal to the surface that it came in through: past the
/// middle of a thin body the nearest surface is the wrong one.
std::optional<Penetration> trace_back(const SignedDistanceField& field, const Eigen::Vector3f& p,
                                      const Eigen::Vector3f& outward, float erosion) {
  const auto longest = static_cast<float>(field.bounds().sizes().norm());
  const auto shortest_step = static_cast<float>(0.1 * field.voxel());
  float way = 0.0F;
  for (int step = 0; step < kMaxTraceSteps && way < longest; ++step) {
    const Eigen::Vector3f q = p - way * outward;
    const DistanceSample at = field.sample(q);
    const float f = at.distance + erosion;
    if (f > -kSurfaceTolerance) {
      const float cosine = -at.gradient.dot(outward);
      // Within 6 degrees of the tangent: the ray may pass by, and its length tells nothing.
      if (cosine < 0.1F) {
        return std::nullopt;
      }
      if (std::abs(f) < kSurfaceTolerance) {
        return Penetration{-static_cast<double>(way), (at.gradient / cosine).cast<double>(),
                           q.cast<double>()};
      }
      way -= f / cosine;  // Newton's method back onto the surface that the last step went through
      continue;
    }
    way += std::max(-f, shortest_step);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Penetration> penetration(const SignedDistanceField& field, const Eigen::Vector3f& p,
                                       const Eigen::Vector3f& outward, float erosion) {
  const DistanceSample at = field.sample(p);
  const float f = at.distance + erosion;
  if (f >= 0.0F) {
    return std::nullopt;
  }
  if (at.gradient.dot(outward) > kFarSideCosine) {
    return trace_back(field, p, outward, erosion);
  }
  return Penetration{static_cast<double>(f), at.gradient.cast<double>(), p.cast<double>()};
}

}  // namespace lockbox
