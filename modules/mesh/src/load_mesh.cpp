// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/mesh/load_mesh.hpp"

#include <fstream>
#include <string>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/core/file_kind.hpp"
#include "lockbox/mesh/repair.hpp"
#include "mesh_readers.hpp"

namespace lockbox {
namespace {

/// Files are read as a whole. A text STL of four million triangles has this size; twice the limit
/// is twice the memory.
constexpr std::size_t kMostBytes = 1'000'000'000;
/// Metres from the origin. No camera sees a thing of this size, and the squares and cubes of such
/// numbers are still far from the end of a double's range.
constexpr double kFarthest = 1e6;

/// Reads a file, also one that has no size before it is read, like a pipe.
std::string read_content(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file.string(), "is a folder, not a mesh");
  }
  std::ifstream stream(file, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::string content;
  while (stream && content.size() <= kMostBytes && (error || size <= kMostBytes)) {
    constexpr std::size_t kAtOnce = 1 << 20;
    const std::size_t before = content.size();
    content.resize(before + kAtOnce);
    stream.read(content.data() + before, kAtOnce);
    content.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad()) {
    throw InputError(file.string(), "the mesh cannot be read; does the file exist?");
  }
  if (content.size() > kMostBytes || (!error && size > kMostBytes)) {
    throw InputError(file.string(), "the file is larger than 1 GB; simplify the mesh");
  }
  if (content.empty()) {
    throw InputError(file.string(), "the mesh is empty");
  }
  return content;
}

PolygonSoup read_polygons(const std::filesystem::path& file) {
  const std::string format = lower_extension(file);
  if (format == ".obj") return read_obj(file, read_content(file));
  if (format == ".stl") return read_stl(file, read_content(file));
  if (format == ".ply") return read_ply(file, read_content(file));
  throw InputError(file.string(), in_quotes(format) +
                                      " meshes are not supported; convert it to .obj, .stl or "
                                      ".ply, for instance with Blender");
}

void apply_scale(PolygonSoup& soup, const Eigen::Vector3d& scale) {
  for (Eigen::Vector3d& vertex : soup.vertices()) {
    vertex = vertex.cwiseProduct(scale);
    if (!(vertex.lpNorm<Eigen::Infinity>() <= kFarthest)) {
      throw InputError(soup.file(),
                       "a vertex is more than 1000 km from the origin; is the file damaged, or its "
                       "scale wrong?");
    }
  }
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
  if (!scale.allFinite() || (scale.array() == 0.0).any()) {
    throw InputError(file.string(), "the mesh's scale has a zero or is not finite");
  }
  PolygonSoup soup = read_polygons(file);
  if (soup.faces() == 0) {
    throw InputError(file.string(), "the mesh has no triangle or other face: " +
                                        std::to_string(soup.vertices().size()) +
                                        " points are no surface");
  }
  apply_scale(soup, scale);
  TriangleMesh mesh = triangulated(soup);
  if (scale.prod() < 0.0) {
    for (auto& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  mesh = one_sided(welded(mesh));
  if (mesh.triangles.empty()) {
    throw InputError(file.string(), "the mesh has no triangle with an area");
  }
  return mesh;
}

}  // namespace lockbox
