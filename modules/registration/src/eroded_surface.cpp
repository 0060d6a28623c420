// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/registration/eroded_surface.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/mesh/surface_sampling.hpp"

namespace lockbox {
namespace {

constexpr double kSamplesPerBody = 4000.0;
constexpr double kFinestSpacing = 0.003;    // metres
constexpr double kCoarsestSpacing = 0.015;  // metres
constexpr int kNewtonSteps = 5;

/// Moved along the field to the level set.
Eigen::Vector3f onto_level(const SignedDistanceField& field, Eigen::Vector3f p, float level) {
  for (int step = 0; step < kNewtonSteps; ++step) {
    const DistanceSample at = field.sample(p);
    p -= (at.distance - level) * at.gradient / std::max(0.25F, at.gradient.squaredNorm());
  }
  return p;
}

/// Samples follow each other along a space-filling curve.
std::vector<ErodedSurface::Patch> patches_of(const std::vector<ErodedSurface::Sample>& samples) {
  std::vector<ErodedSurface::Patch> patches;
  for (std::size_t first = 0; first < samples.size(); first += ErodedSurface::kSamplesInPatch) {
    const std::size_t size = std::min(ErodedSurface::kSamplesInPatch, samples.size() - first);
    Eigen::AlignedBox3d box;
    for (std::size_t i = first; i < first + size; ++i) {
      box.extend(samples[i].p_body.cast<double>());
    }
    patches.push_back({first, kernels::padded(size), box.center(), 0.5 * box.diagonal().norm()});
  }
  return patches;
}

}  // namespace

ErodedSurface::ErodedSurface(const ArticulatedModel& model, int body_index, double erosion_depth)
    : body(body_index), erosion(erosion_depth) {
  const TriangleMesh& mesh = model.tree.bodies[static_cast<std::size_t>(body)].mesh;
  const SignedDistanceField& field = *model.fields[static_cast<std::size_t>(body)];
  const double spacing =
      std::clamp(std::sqrt(surface_area(mesh) / kSamplesPerBody), kFinestSpacing, kCoarsestSpacing);
  const auto level = static_cast<float>(-erosion);
  double total = 0.0;
  for (const SurfaceSample& point : sample_surface(mesh, spacing)) {
    const Eigen::Vector3f p = onto_level(field, point.position.cast<float>(), level);
    const DistanceSample at = field.sample(p);
    if (std::abs(at.distance - level) > 0.25F * static_cast<float>(field.voxel())) {
      continue;  // buried in another shell of the same body, or at a medial axis
    }
    samples.push_back({p, at.gradient.normalized(), point.area});
    total += point.area;
  }
  for (Sample& sample : samples) {
    sample.share /= total;
    x.push_back(sample.p_body.x());
    y.push_back(sample.p_body.y());
    z.push_back(sample.p_body.z());
  }
  for (auto* axis : {&x, &y, &z}) {
    axis->resize(kernels::padded(samples.size()), kernels::kPadding);
  }
  patches = patches_of(samples);
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
