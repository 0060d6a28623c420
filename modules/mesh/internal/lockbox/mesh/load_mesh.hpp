// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Reads an .obj, .stl (text or binary) or .ply file: polygons are cut into triangles, equal
/// vertices merged, triangles without area dropped, and faces that are there for both sides made
/// one_sided(). Normals, texture, colours, lines and points are not looked at. scale turns the
/// file's unit into metres, axis by axis; a mirroring one turns the faces too, so that outside
/// stays outside.
///
/// Throws InputError naming the file, with the line where there are lines: missing or unreadable,
/// another format, truncated or garbled, an index without its vertex, a coordinate that is not
/// finite or farther than 1000 km, no triangle left, a scale with a zero; and what is too large:
/// files above 1 GB, 30 million vertices, 10 million triangles (30 million corners of faces), faces
/// with more than 10 000 corners. Counts are compared with the file's size before memory is taken.
TriangleMesh load_mesh(const std::filesystem::path& file,
                       const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

}  // namespace lockbox
