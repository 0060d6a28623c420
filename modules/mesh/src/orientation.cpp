// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <unordered_map>
#include <utility>

#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"
#include "lockbox/mesh/winding.hpp"

namespace lockbox {
namespace {

void turn(std::array<std::uint32_t, 3>& triangle) {
  std::swap(triangle[1], triangle[2]);
}

struct Neighbour {
  std::uint32_t triangle;
  bool consistent;
};

std::vector<std::vector<Neighbour>> neighbours_across_manifold_edges(const TriangleMesh& mesh) {
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    if (edge.size() == 2) {
      const bool consistent = edge[0].forward != edge[1].forward;
      neighbours[edge[0].triangle].push_back({edge[1].triangle, consistent});
      neighbours[edge[1].triangle].push_back({edge[0].triangle, consistent});
    }
  });
  return neighbours;
}

/// Makes the triangles of one shell agree with the majority of its area.
void make_shell_consistent(TriangleMesh& mesh, std::uint32_t first,
                           const std::vector<std::vector<Neighbour>>& neighbours,
                           std::vector<std::uint8_t>& visited) {
  struct Member {
    std::uint32_t triangle;
    bool turned;
  };
  std::vector<Member> members = {{first, false}};
  visited[first] = 1;
  double unturned_area = 0.0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Member member = members[i];
    const double area = area_vector(mesh.corners(member.triangle)).norm();
    unturned_area += member.turned ? -area : area;
    for (const Neighbour& next : neighbours[member.triangle]) {
      if (visited[next.triangle] == 0) {
        visited[next.triangle] = 1;
        members.push_back({next.triangle, member.turned == next.consistent});
      }
    }
  }
  const bool majority_turned = unturned_area < 0.0;
  for (const Member& member : members) {
    if (member.turned != majority_turned) {
      turn(mesh.triangles[member.triangle]);
    }
  }
}

void make_neighbours_consistent(TriangleMesh& mesh) {
  const auto neighbours = neighbours_across_manifold_edges(mesh);
  std::vector<std::uint8_t> visited(mesh.triangles.size(), 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (visited[t] == 0) {
      make_shell_consistent(mesh, t, neighbours, visited);
    }
  }
}

/// The triangles of a shell as a mesh of their own, and what it encloses.
struct Shell {
  TriangleMesh mesh;
  std::vector<std::uint32_t> members;
  Eigen::AlignedBox3d box;
  double volume = 0.0;
  bool closed = false;
};

/// The faces of a closed surface cancel; a hole leaves its own area.
bool is_closed(const TriangleMesh& mesh) {
  constexpr double kOpenShare = 1e-2;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += area_vector(mesh.corners(t));
  }
  return sum.norm() <= kOpenShare * surface_area(mesh);
}

Shell make_shell(const TriangleMesh& mesh, std::vector<std::uint32_t> members) {
  Shell shell;
  for (const std::uint32_t t : members) {
    shell.mesh.triangles.push_back(mesh.triangles[t]);
  }
  std::unordered_map<std::uint32_t, std::uint32_t> renumbered;
  for (auto& triangle : shell.mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      const auto next = static_cast<std::uint32_t>(shell.mesh.vertices.size());
      const auto [entry, is_new] = renumbered.try_emplace(vertex, next);
      if (is_new) {
        shell.mesh.vertices.push_back(mesh.vertices[vertex]);
      }
      vertex = entry->second;
    }
  }
  shell.members = std::move(members);
  shell.box = bounds(shell.mesh);
  shell.volume = signed_volume(shell.mesh);
  shell.closed = is_closed(shell.mesh);
  return shell;
}

/// The closed shells, and as one more all other triangles together.
std::vector<Shell> split_into_shells(const TriangleMesh& mesh) {
  const Shells found = find_shells(mesh);
  std::vector<std::vector<std::uint32_t>> members(found.count);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    members[found.of_triangle[t]].push_back(t);
  }
  std::vector<Shell> shells;
  std::vector<std::uint32_t> patches;
  for (auto& triangles : members) {
    Shell shell = make_shell(mesh, std::move(triangles));
    if (shell.closed) {
      shells.push_back(std::move(shell));
    } else {
      patches.insert(patches.end(), shell.members.begin(), shell.members.end());
    }
  }
  if (!patches.empty()) {
    shells.push_back(make_shell(mesh, std::move(patches)));
  }
  return shells;
}

/// Whether a handful of the inner shell's vertices all lie inside the outer one.
bool contains(const Shell& outer, const Shell& inner) {
  constexpr std::size_t kProbes = 8;
  if (!outer.box.contains(inner.box)) {
    return false;
  }
  const std::size_t step = inner.mesh.vertices.size() / kProbes + 1;
  for (std::size_t i = 0; i < inner.mesh.vertices.size(); i += step) {
    if (std::abs(winding_number(outer.mesh, inner.mesh.vertices[i])) < 0.5) {
      return false;
    }
  }
  return true;
}

}  // namespace

TriangleMesh oriented_outwards(TriangleMesh mesh) {
  make_neighbours_consistent(mesh);
  const std::vector<Shell> shells = split_into_shells(mesh);
  for (const Shell& shell : shells) {
    // The outermost shell around this one decides for both.
    const Shell* outermost = &shell;
    for (const Shell& other : shells) {
      if (&other != outermost && other.closed && contains(other, *outermost)) {
        outermost = &other;
      }
    }
    if (outermost->closed && outermost->volume < 0.0) {
      for (const std::uint32_t t : shell.members) {
        turn(mesh.triangles[t]);
      }
    }
  }
  return mesh;
}

}  // namespace lockbox
