// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/eroded_surface.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/kernels/point_to_field.hpp"

namespace lockbox {
namespace {

/// Samples of a body's surface, about, within the spacings below. Source: not recorded. Doubled,
/// collisions take up to twice as long.
constexpr double kSamplesPerBody = 4000.0;
constexpr double kFinestSpacing = 0.003;    // metres
constexpr double kCoarsestSpacing = 0.015;  // metres
/// Steps of Newton's method to the level, at most; each is a look-up in the field. Source: not
/// recorded. Doubled, more is tried of points near medial axes, which are left out otherwise.
constexpr int kNewtonSteps = 5;
/// Squared length of a gradient, at least, so that no step is longer than twice the distance: near
/// medial axes tri-linear gradients vanish. Source: not recorded. Doubled, none is
/// longer than 1.4 times.
constexpr float kLeastGradient2 = 0.25F;
constexpr float kExactly = 1e-6F;  // metres: single precision tells no less

/// Moves a point along the field to the level set. Returns the field there.
DistanceSample move_onto_level(const SignedDistanceField& field, float level, Eigen::Vector3f& p) {
  DistanceSample at = field.sample(p);
  for (int step = 0; step < kNewtonSteps && std::abs(at.distance - level) > kExactly; ++step) {
    p -= (at.distance - level) * at.gradient / std::max(kLeastGradient2, at.gradient.squaredNorm());
    at = field.sample(p);
  }
  return at;
}

/// Samples follow each other along a space-filling curve.
std::vector<ErodedSurface::Group> groups_of(const std::vector<ErodedSurface::Sample>& samples) {
  std::vector<ErodedSurface::Group> groups;
  for (std::size_t first = 0; first < samples.size(); first += ErodedSurface::kSamplesInGroup) {
    const std::size_t size = std::min(ErodedSurface::kSamplesInGroup, samples.size() - first);
    Eigen::AlignedBox3d box;
    for (std::size_t i = first; i < first + size; ++i) {
      box.extend(samples[i].p_body.cast<double>());
    }
    groups.push_back({first, kernels::padded(size), box.center(), 0.5 * box.diagonal().norm()});
  }
  return groups;
}

}  // namespace

std::vector<SurfaceSample> collision_samples(const TriangleMesh& mesh) {
  const double spacing = std::sqrt(surface_area(mesh) / kSamplesPerBody);
  return sample_surface(mesh, std::clamp(spacing, kFinestSpacing, kCoarsestSpacing));
}

ErodedSurface erode(const SignedDistanceField& field, std::span<const SurfaceSample> surface,
                    double erosion) {
  ErodedSurface eroded;
  const auto level = static_cast<float>(-erosion);
  // A quarter of a voxel: what comes no nearer than that is not on the level.
  const float tolerance = 0.25F * static_cast<float>(field.voxel());
  double total = 0.0;
  for (const SurfaceSample& point : surface) {
    Eigen::Vector3f p = point.position.cast<float>();
    const DistanceSample at = move_onto_level(field, level, p);
    if (std::abs(at.distance - level) > tolerance) {
      continue;  // buried in another shell of the same body, or at a medial axis
    }
    eroded.samples.push_back({p, at.gradient.normalized(), point.area});
    total += point.area;
  }
  for (ErodedSurface::Sample& sample : eroded.samples) {
    sample.share /= total;
    eroded.x.push_back(sample.p_body.x());
    eroded.y.push_back(sample.p_body.y());
    eroded.z.push_back(sample.p_body.z());
  }
  for (auto* axis : {&eroded.x, &eroded.y, &eroded.z}) {
    axis->resize(kernels::padded(eroded.samples.size()), kernels::kPadding);
  }
  eroded.groups = groups_of(eroded.samples);
  return eroded;
}

double ErodedSurface::deepest_in(const SignedDistanceField& other,
                                 const Eigen::Isometry3d& T_other_body) const {
  const Eigen::Isometry3f T = T_other_body.cast<float>();
  double depth = 0.0;
  for (const Sample& sample : samples) {
    depth = std::max(depth, -static_cast<double>(other.sample(T * sample.p_body).distance));
  }
  return depth;
}

}  // namespace lockbox
