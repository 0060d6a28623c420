// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_model/link.h>

#include <Eigen/Geometry>

#include "lockbox/model/kinematic_tree.hpp"
#include "mesh_locator.hpp"
#include "visual_extent.hpp"

namespace lockbox {

/// T_parent_child of a URDF origin.
Eigen::Isometry3d isometry(const urdf::Pose& pose);

/// Triangles and colour of a visual, in the frame of its link. mesh_scale: see LoadOptions. Throws
/// InputError.
ColoredMesh visual_mesh(const urdf::Visual& visual, const MeshLocator& locator, double mesh_scale);

/// The shape, and file and scale of a mesh; the rest is not set.
VisualExtent described(const urdf::Geometry& geometry);

}  // namespace lockbox
