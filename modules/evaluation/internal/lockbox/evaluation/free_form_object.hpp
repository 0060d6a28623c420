// SPDX-License-Identifier: BSD-3-Clause
// Round and free-form objects that nobody tuned for: things of a household without flat sides.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/mesh/triangle_mesh.hpp"
#include "lockbox/simulation/object_block.hpp"

namespace lockbox {

struct FreeFormLink {
  std::string name;
  TriangleMesh mesh;  ///< of closed surfaces that may overlap; link frame, metres
};

/// A hinge between a link and the one before it.
struct FreeFormHinge {
  Eigen::Vector3d origin;  ///< in the frame of the link before
  Eigen::Vector3d axis;
  double lower;  ///< radians
  double upper;
};

/// A chain of links, each on the one before; z is up where it stands, its foot is at z = 0.
struct FreeFormObject {
  std::string name;  ///< of its kind: `mug`, `bottle`
  std::vector<FreeFormLink> links;
  std::vector<FreeFormHinge> hinges;  ///< one fewer than links
};

/// Kinds by turns, their proportions drawn; no kind of the tuning block is one of a test block.
FreeFormObject draw_free_form(const ObjectBlock& block, std::uint64_t number);

/// Writes its meshes and a URDF into the folder, which exists; returns the URDF's path. Throws
/// InputError if a file cannot be written.
std::filesystem::path write_free_form(const FreeFormObject& object,
                                      const std::filesystem::path& folder);

}  // namespace lockbox
