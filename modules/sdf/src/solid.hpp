// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "outer_surface.hpp"

namespace lockbox {

/// A mesh made ready: what the distances and signs of its field are computed from.
class Solid {
 public:
  /// Throws InputError where build_field says so for the mesh.
  Solid(const TriangleMesh& input, const Executor& executor);
  // The parts refer to each other by number only, but are large: nobody needs a copy.
  Solid(const Solid&) = delete;
  Solid& operator=(const Solid&) = delete;

  const WindingTree& winding() const { return winding_; }
  const OuterSurface& surface() const { return surface_; }
  /// Returns the tree over the triangles of surface().
  const TriangleTree& tree() const { return tree_; }
  const Eigen::AlignedBox3d& bounds() const { return tree_.nodes().front().box; }
  /// m^2
  double area() const { return area_; }
  /// Returns the thickness of the thinnest wall, metres; see wall_thickness.hpp.
  double thickness() const { return thickness_; }
  /// Returns for each slot of the tree whether its triangle is at an open edge.
  std::vector<std::uint8_t> open_slots() const;

 private:
  TriangleMesh mesh_;
  WindingTree winding_;
  OuterSurface surface_;
  TriangleTree tree_;
  double area_;
  double thickness_;
};

}  // namespace lockbox
