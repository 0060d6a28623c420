// SPDX-License-Identifier: BSD-3-Clause
#include "contacts.hpp"

#include <algorithm>
#include <limits>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox::app {
namespace {

constexpr double kSpacing = 0.004;  // metres between samples of a surface

std::vector<Eigen::Vector3d> surface_points(const TriangleMesh& mesh) {
  std::vector<Eigen::Vector3d> points = mesh.vertices;  // corners penetrate deepest
  for (const auto& sample : sample_surface(mesh, kSpacing)) points.push_back(sample.position);
  return points;
}

/// How deep the points reach into the field; negative: how far they stay away.
double penetration(const std::vector<Eigen::Vector3d>& points, const SignedDistanceField& field,
                   const Eigen::Isometry3d& T_field_points) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const auto& point : points) {
    const Eigen::Vector3f p_field = (T_field_points * point).cast<float>();
    deepest = std::max(deepest, -static_cast<double>(field.sample(p_field).distance));
  }
  return deepest;
}

}  // namespace

std::vector<Contact> rest_contacts(const ArticulatedModel& model) {
  const auto& bodies = model.tree.bodies;
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, rest_configuration(model.tree), poses);
  std::vector<std::vector<Eigen::Vector3d>> points;
  for (const auto& body : bodies) points.push_back(surface_points(body.mesh));

  std::vector<Contact> contacts;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      if (!model.fields[a] || !model.fields[b]) continue;
      const Eigen::Isometry3d T_b_a = poses[b].inverse() * poses[a];
      const double overlap = std::max(penetration(points[a], *model.fields[b], T_b_a),
                                      penetration(points[b], *model.fields[a], T_b_a.inverse()));
      if (overlap > -kContactTolerance) contacts.push_back({a, b, overlap});
    }
  }
  return contacts;
}

}  // namespace lockbox::app
