// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Reads an .obj, .stl (text or binary) or .ply file: polygons are cut into triangles, equal
/// vertices merged, triangles without area dropped. scale turns the file's unit into metres, axis
/// by axis; a mirroring one turns the faces too, so that outside stays outside.
///
/// Throws InputError naming the file, with the line where there are lines: missing or unreadable,
/// another format, truncated or garbled, an index without its vertex, a number that is not finite,
/// no triangle left, a scale with a zero.
TriangleMesh load_mesh(const std::filesystem::path& file,
                       const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

}  // namespace lockbox
