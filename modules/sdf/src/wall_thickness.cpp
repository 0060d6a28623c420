// SPDX-License-Identifier: BSD-3-Clause
#include "wall_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lockbox/mesh/surface_sampling.hpp"
#include "lockbox/mesh/topology.hpp"

namespace lockbox {
namespace {

constexpr double kQuantile = 0.05;

/// One mesh for each shell with its exposed triangles.
std::vector<TriangleMesh> exposed_shells(const OuterSurface& surface, const TriangleMesh& mesh) {
  const Shells shells = find_shells(mesh);
  std::vector<TriangleMesh> exposed(shells.count);
  for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    TriangleMesh& shell = exposed[shells.of_triangle[surface.source[t]]];
    const auto first = static_cast<std::uint32_t>(shell.vertices.size());
    const Corners corners = surface.mesh.corners(t);
    shell.vertices.insert(shell.vertices.end(), corners.begin(), corners.end());
    shell.triangles.push_back({first, first + 1, first + 2});
  }
  return exposed;
}

std::vector<double> ways_through(const TriangleMesh& shell, double sample_count, double stand_off,
                                 const TriangleTree& tree, const WindingTree& winding,
                                 const Executor& executor) {
  constexpr std::size_t kTogether = 32;
  const std::vector<SurfaceSample> samples =
      sample_surface(shell, std::sqrt(surface_area(shell) / sample_count));
  std::vector<double> ways(samples.size(), std::numeric_limits<double>::infinity());
  executor.for_each_chunk(
      samples.size(), kTogether, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
          const Eigen::Vector3d aside = stand_off * samples[i].normal;
          const Eigen::Vector3d start = samples[i].position - aside;
          const bool is_surface =
              winding.is_inside(start) && !winding.is_inside(samples[i].position + aside);
          if (is_surface) ways[i] = tree.exit_distance(start, -samples[i].normal) + stand_off;
        }
      });
  std::erase_if(ways, [](double way) { return !std::isfinite(way); });
  return ways;
}

}  // namespace

double thinnest_wall(const OuterSurface& surface, const TriangleTree& tree,
                     const TriangleMesh& mesh, const WindingTree& winding,
                     const Executor& executor) {
  constexpr double kSamplesInAll = 8000.0;
  const std::vector<TriangleMesh> shells = exposed_shells(surface, mesh);
  const double diagonal = bounds(surface.mesh).diagonal().norm();
  const double samples =
      std::clamp(kSamplesInAll / static_cast<double>(shells.size()), 20.0, 1000.0);
  double thinnest = diagonal;
  for (const TriangleMesh& shell : shells) {
    std::vector<double> ways =
        ways_through(shell, samples, 2e-5 * diagonal, tree, winding, executor);
    if (!ways.empty()) {
      const auto rank = static_cast<std::ptrdiff_t>(kQuantile * static_cast<double>(ways.size()));
      std::nth_element(ways.begin(), ways.begin() + rank, ways.end());
      thinnest = std::min(thinnest, ways[static_cast<std::size_t>(rank)]);
    }
  }
  return thinnest;
}

}  // namespace lockbox
