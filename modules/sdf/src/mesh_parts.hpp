// SPDX-License-Identifier: BSD-3-Clause
// The solids of which a mesh consists: what can bury another part, or be buried.
#pragma once

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Each closed shell is a part; all that is not closed is one together, the last, for it bounds
/// nothing alone.
struct MeshParts {
  explicit MeshParts(const TriangleMesh& mesh);

  std::size_t open_part() const { return boxes.size() - 1; }

  std::vector<std::uint32_t> of_triangle;
  std::vector<Eigen::AlignedBox3d> boxes;  ///< of a part without triangles empty
};

}  // namespace lockbox
