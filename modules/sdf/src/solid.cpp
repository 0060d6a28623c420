// SPDX-License-Identifier: BSD-3-Clause
#include "solid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/mesh/repair.hpp"
#include "lockbox/mesh/topology.hpp"
#include "wall_thickness.hpp"

namespace lockbox {
namespace {

void require_valid(const TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (vertex >= mesh.vertices.size() || !mesh.vertices[vertex].allFinite()) {
        throw InputError("geometry", "a triangle has a corner that is missing or not finite");
      }
    }
  }
}

/// Refuses a size before anything is computed that takes long for it. Twice as large, twice as much
/// may be wrong with what is let through; depth cameras see some metres.
void require_size_of_a_thing(const TriangleMesh& mesh) {
  constexpr double kLargest = 100.0;  // metres
  if (mesh.vertices.empty()) return;
  const double size = bounds(mesh).sizes().maxCoeff();
  if (size <= kLargest) return;
  throw InputError("geometry", "it is " + readable_length(size) +
                                   " large; are its lengths in metres, or is a vertex far off?");
}

/// Welded, oriented, small holes closed; or refused.
TriangleMesh mended(const TriangleMesh& mesh) {
  require_valid(mesh);
  require_size_of_a_thing(mesh);
  TriangleMesh result = with_small_holes_closed(oriented_outwards(welded(mesh)));
  if (result.triangles.empty()) {
    throw InputError("geometry", "the mesh has no triangle with an area");
  }
  return result;
}

OuterSurface closed_surface(const TriangleMesh& mesh, const WindingTree& winding,
                            const Executor& executor) {
  constexpr double kMostOpen = 0.01;
  const double share = open_share(mesh, winding);
  if (share > kMostOpen) {
    const long percent = std::lround(100.0 * std::min(share, 1.0));
    throw InputError("geometry",
                     "the surface is open: about " + std::to_string(percent) +
                         " % of it is missing or faces the wrong way, so that inside and outside "
                         "are not defined; close its holes (MeshLab: Close Holes; Blender: Mesh > "
                         "Clean Up > Fill Holes), or give what is drawn without thickness one "
                         "(Blender: the modifier Solidify)");
  }
  OuterSurface surface = find_outer_surface(mesh, winding, executor);
  if (surface.mesh.triangles.empty() || surface.volume <= 0.0) {
    throw InputError("geometry",
                     "the surface encloses no volume; a link needs a solid: give what is "
                     "drawn without thickness one (Blender: the modifier Solidify)");
  }
  return surface;
}

}  // namespace

Solid::Solid(const TriangleMesh& input, const Executor& executor)
    : mesh_(mended(input)),
      winding_(mesh_),
      surface_(closed_surface(mesh_, winding_, executor)),
      tree_(surface_.mesh),
      area_(surface_area(surface_.mesh)),
      thickness_(thinnest_wall(surface_, tree_, mesh_, winding_, executor)) {}

std::vector<std::uint8_t> Solid::open_slots() const {
  const auto open = triangles_at_open_edges(mesh_);
  std::vector<std::uint8_t> slots;
  slots.reserve(tree_.corners().size());
  for (std::uint32_t slot = 0; slot < tree_.corners().size(); ++slot) {
    slots.push_back(open[surface_.source[tree_.triangle_of(slot)]]);
  }
  return slots;
}

}  // namespace lockbox
