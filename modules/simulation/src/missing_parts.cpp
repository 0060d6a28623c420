// SPDX-License-Identifier: BSD-3-Clause
#include "missing_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/core/error.hpp"
#include "lockbox/mesh/topology.hpp"
#include "lockbox/model/configuration.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/simulation/deviating_model.hpp"

namespace lockbox {
namespace simulation {
namespace {

/// A shell of a body's mesh.
struct Handle {
  std::size_t body;
  std::uint32_t shell;
};

/// The shells of that body that stand farther out in this direction (of its frame) than all others.
/// A body of one shell has none.
void append_handles(const KinematicTree& tree, std::size_t body, const Eigen::Vector3d& front,
                    std::vector<Handle>& handles) {
  constexpr double kOut = 0.005;  // metres
  const TriangleMesh& mesh = tree.bodies[body].mesh;
  const Shells shells = find_shells(mesh);
  std::vector<double> reach(shells.count, -std::numeric_limits<double>::infinity());
  std::vector<double> area(shells.count, 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t shell = shells.of_triangle[t];
    area[shell] += area_vector(mesh.corners(t)).norm();
    for (const Eigen::Vector3d& corner : mesh.corners(t)) {
      reach[shell] = std::max(reach[shell], front.dot(corner));
    }
  }
  const auto largest = std::max_element(area.begin(), area.end());
  if (shells.count < 2) return;
  const double surface = reach[static_cast<std::size_t>(largest - area.begin())];
  for (std::uint32_t shell = 0; shell < shells.count; ++shell) {
    if (reach[shell] > surface + kOut) handles.push_back({body, shell});
  }
}

std::vector<Handle> find_handles(const KinematicTree& tree) {
  std::vector<Eigen::Isometry3d> T_base_body;
  forward_kinematics(tree, rest_configuration(tree), T_base_body);
  std::vector<Handle> handles;
  for (std::size_t b = 1; b < tree.bodies.size(); ++b) {
    append_handles(tree, b, T_base_body[b].linear().row(2).transpose(), handles);
  }
  if (handles.empty()) append_handles(tree, 0, Eigen::Vector3d::UnitZ(), handles);
  return handles;
}

/// The mesh without the triangles of that shell, and without vertices that no triangle uses.
TriangleMesh without_shell(const TriangleMesh& mesh, std::uint32_t shell) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  const Shells shells = find_shells(mesh);
  std::vector<std::uint32_t> kept(mesh.vertices.size(), kUnused);
  TriangleMesh rest;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (shells.of_triangle[t] == shell) continue;
    auto& triangle = rest.triangles.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::uint32_t& index = kept[mesh.triangles[t][corner]];
      if (index == kUnused) {
        index = static_cast<std::uint32_t>(rest.vertices.size());
        rest.vertices.push_back(mesh.vertices[mesh.triangles[t][corner]]);
      }
      triangle[corner] = index;
    }
  }
  return rest;
}

std::size_t body_with_link(const KinematicTree& tree, const std::string& link) {
  std::string choices;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const auto& links = tree.bodies[b].links;
    if (std::find(links.begin(), links.end(), link) != links.end()) return b;
    if (b > 0) choices += (choices.empty() ? "" : ", ") + tree.bodies[b].name;
  }
  throw InputError("missing_parts", "the model has no link '" + link + "'; " +
                                        (choices.empty() ? "it has no moving parts"
                                                         : "its moving parts are " + choices));
}

}  // namespace

void take_parts(KinematicTree& tree, const std::vector<std::string>& links) {
  std::vector<bool> taken(tree.bodies.size(), false);
  for (const std::string& link : links) {
    const std::size_t body = body_with_link(tree, link);
    if (body == 0)
      throw InputError("missing_parts", "'" + link + "' is the base; it must be there");
    taken[body] = true;
  }
  for (std::size_t b = 1; b < tree.bodies.size(); ++b) {
    const auto parent = static_cast<std::size_t>(tree.joints[b - 1].parent_body);
    taken[b] = taken[b] || taken[parent];
    if (taken[b]) tree.bodies[b].mesh = {};
  }
}

void take_handles(KinematicTree& tree, int count, RandomDraws& random) {
  for (int i = 0; i < count; ++i) {
    const std::vector<Handle> handles = find_handles(tree);
    if (handles.empty()) {
      throw InputError("missing_handles", tree.name + " has only " + std::to_string(i) +
                                              " pieces that stand out of a part's front");
    }
    const auto number = static_cast<double>(handles.size());
    const auto drawn = static_cast<std::size_t>(random.uniform(0.0, number));
    const Handle& handle = handles[std::min(drawn, handles.size() - 1)];
    TriangleMesh& mesh = tree.bodies[handle.body].mesh;
    mesh = without_shell(mesh, handle.shell);
  }
}

}  // namespace simulation

int count_handles(const KinematicTree& tree) {
  return static_cast<int>(simulation::find_handles(tree).size());
}

}  // namespace lockbox
