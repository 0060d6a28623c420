// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_model/model.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "mesh_locator.hpp"
#include "visual_extent.hpp"

namespace lockbox {

/// Bodies with their meshes, parents before children; joint j moves body j + 1.
struct RigidBodies {
  std::vector<Body> bodies;   ///< Body::mesh unset, visuals in no particular order
  std::vector<Joint> joints;  ///< variable unset, multiplier and offset as in the file
  std::map<std::string, std::string> mimics;  ///< mimic joint to the joint that drives it
  std::vector<VisualExtent> extents;          ///< of all visuals
};

/// Merges the links that fixed joints connect, and reads all visual geometry. mesh_scale: see
/// LoadOptions. refuse_link is called with a link's name and the reason when a visual cannot be
/// read; it must throw.
RigidBodies assemble_rigid_bodies(
    const urdf::ModelInterface& urdf, const MeshLocator& locator, double mesh_scale,
    const std::function<void(const std::string&, const std::string&)>& refuse_link);

}  // namespace lockbox
