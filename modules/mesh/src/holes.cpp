// SPDX-License-Identifier: BSD-3-Clause
#include <unordered_map>

#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

/// A hole that is closed has at most this share of the area of the shell around it, and of its
/// diagonal. Larger ones may be meant: the mouth of a cup, the narrow side of a case.
constexpr double kLargestArea = 0.01;
constexpr double kLargestDiagonal = 0.2;
/// Of a shell's area, all its holes together: what is riddled is no surface.
constexpr double kMostHoles = 0.05;

/// The border of a hole, as the patch that closes it runs along it.
struct Rim {
  std::vector<std::uint32_t> vertices;
  std::uint32_t triangle;  ///< beside it
};

/// Follows open edges from vertex to vertex.
class RimFinder {
 public:
  explicit RimFinder(const TriangleMesh& mesh) {
    for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
      if (edge.size() == 1) add(edge.front());
    });
  }

  /// Only borders that meet no other one, nor themselves: how to close those is no question.
  std::vector<Rim> simple_rims() {
    std::vector<Rim> rims;
    for (const std::uint32_t start : starts_) {
      Rim rim{{}, steps_.at(start).triangle};
      std::uint32_t vertex = start;
      while (true) {
        const auto step = steps_.find(vertex);
        if (step == steps_.end() || step->second.is_done || is_forked(step->second)) break;
        step->second.is_done = true;
        rim.vertices.push_back(vertex);
        vertex = step->second.to;
      }
      if (vertex == start && rim.vertices.size() > 2) rims.push_back(std::move(rim));
    }
    return rims;
  }

 private:
  struct Step {
    std::uint32_t to = 0;
    std::uint32_t triangle = 0;
    int leaving = 0;   ///< open edges from the vertex
    int arriving = 0;  ///< open edges to the vertex
    bool is_done = false;
  };

  static bool is_forked(const Step& step) { return step.leaving != 1 || step.arriving != 1; }

  /// The patch runs against its neighbour.
  void add(const HalfEdge& half) {
    const std::uint32_t from = half.forward ? half.high : half.low;
    const std::uint32_t to = half.forward ? half.low : half.high;
    Step& step = steps_[from];
    step.to = to;
    step.triangle = half.triangle;
    ++step.leaving;
    ++steps_[to].arriving;
    starts_.push_back(from);
  }

  std::unordered_map<std::uint32_t, Step> steps_;  ///< by the vertex that they leave
  std::vector<std::uint32_t> starts_;
};

/// A fan around the middle of a rim.
TriangleMesh patch_for(const Rim& rim, const TriangleMesh& mesh) {
  TriangleMesh patch;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::uint32_t vertex : rim.vertices) {
    patch.vertices.push_back(mesh.vertices[vertex]);
    middle += mesh.vertices[vertex];
  }
  const auto corners = static_cast<std::uint32_t>(rim.vertices.size());
  patch.vertices.emplace_back(middle / static_cast<double>(corners));
  for (std::uint32_t i = 0; i < corners; ++i) {
    patch.triangles.push_back({i, (i + 1) % corners, corners});
  }
  return patch;
}

struct ShellSize {
  double area = 0.0;  ///< m^2
  Eigen::AlignedBox3d box;
  double holes = 0.0;  ///< m^2
};

std::vector<ShellSize> shell_sizes(const TriangleMesh& mesh, const Shells& shells) {
  std::vector<ShellSize> sizes(shells.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    ShellSize& size = sizes[shells.of_triangle[t]];
    size.area += area_vector(mesh.corners(t)).norm();
    for (const Eigen::Vector3d& corner : mesh.corners(t)) size.box.extend(corner);
  }
  return sizes;
}

}  // namespace

TriangleMesh with_small_holes_closed(const TriangleMesh& mesh) {
  struct Patch {
    TriangleMesh mesh;
    std::uint32_t shell;
  };
  const Shells shells = find_shells(mesh);
  std::vector<ShellSize> sizes = shell_sizes(mesh, shells);
  std::vector<Patch> patches;
  for (const Rim& rim : RimFinder(mesh).simple_rims()) {
    Patch patch{patch_for(rim, mesh), shells.of_triangle[rim.triangle]};
    ShellSize& shell = sizes[patch.shell];
    const double area = surface_area(patch.mesh);
    const double diagonal = bounds(patch.mesh).diagonal().norm();
    if (area <= kLargestArea * shell.area &&
        diagonal <= kLargestDiagonal * shell.box.diagonal().norm()) {
      shell.holes += area;
      patches.push_back(std::move(patch));
    }
  }
  std::erase_if(patches, [&](const Patch& patch) {
    return sizes[patch.shell].holes > kMostHoles * sizes[patch.shell].area;
  });
  TriangleMesh result = mesh;
  for (const Patch& patch : patches) append(result, patch.mesh);
  return patches.empty() ? mesh : welded(result);
}

}  // namespace lockbox
