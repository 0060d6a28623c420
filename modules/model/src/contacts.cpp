// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

constexpr double kSpacing = 0.004;    // metres between samples of a surface
constexpr double kMostSamples = 2e6;  // of all surfaces: 100 MB; large ones are sampled coarsely
constexpr double kReach = 0.001;      // metres; farther apart is no contact
constexpr double kFacing = -0.8;      // cosine between the normals of faces that lie on each other

/// Signed distances to the field of those samples that face its surface and lie on it or below it.
void append_contact_distances(const std::vector<SurfaceSample>& samples,
                              const SignedDistanceField& field,
                              const Eigen::Isometry3d& T_field_samples,
                              std::vector<double>& distances) {
  for (const auto& sample : samples) {
    const auto at = field.sample((T_field_samples * sample.position).cast<float>());
    const Eigen::Vector3d normal = T_field_samples.linear() * sample.normal;
    if (at.distance < kReach && at.gradient.cast<double>().dot(normal) < kFacing) {
      distances.push_back(at.distance);
    }
  }
}

/// Half of the values are smaller. Single samples say little: at edges fields round.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double spacing_for(const std::vector<Body>& bodies) {
  double area = 0.0;
  for (const Body& body : bodies) area += surface_area(body.mesh);
  return std::max(kSpacing, std::sqrt(area / kMostSamples));
}

}  // namespace

std::vector<Contact> rest_contacts(const ArticulatedModel& model) {
  const auto& bodies = model.tree.bodies;
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, rest_configuration(model.tree), poses);
  const double spacing = spacing_for(bodies);
  std::vector<std::vector<SurfaceSample>> samples;
  samples.reserve(bodies.size());
  for (const auto& body : bodies) {
    samples.push_back(body.visuals.empty() ? std::vector<SurfaceSample>()
                                           : sample_surface(body.mesh, spacing));
  }

  std::vector<Contact> contacts;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (!model.fields[a] || !model.fields[b]) continue;
      const Eigen::Isometry3d T_b_a = poses[b].inverse() * poses[a];
      std::vector<double> distances;
      append_contact_distances(samples[a], *model.fields[b], T_b_a, distances);
      append_contact_distances(samples[b], *model.fields[a], T_b_a.inverse(), distances);
      if (!distances.empty()) contacts.push_back({a, b, -median(distances)});
    }
  }
  return contacts;
}

}  // namespace lockbox
