// SPDX-License-Identifier: BSD-3-Clause
// What a mesh file holds, before anything is made of it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Vertices, and polygons over them. Faces may come before their vertices; whether these exist is
/// for the reader to say, which knows the line.
class PolygonSoup {
 public:
  explicit PolygonSoup(std::string file) : file_(std::move(file)) {}

  /// These throw InputError when the mesh becomes larger than load_mesh() says, before it does.
  void add_vertex(const Eigen::Vector3d& vertex);
  void add_corner(std::uint32_t vertex);

  /// The corners added since the last face are one; fewer than three have no area and are dropped.
  void end_face();

  const std::string& file() const { return file_; }
  std::vector<Eigen::Vector3d>& vertices() { return vertices_; }
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  std::size_t faces() const { return face_ends_.size(); }
  std::span<const std::uint32_t> face(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : face_ends_[i - 1];
    return std::span(corners_).subspan(begin, face_ends_[i] - begin);
  }

 private:
  std::size_t face_begin() const { return face_ends_.empty() ? 0 : face_ends_.back(); }

  std::string file_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<std::uint32_t> corners_;  ///< those of the first face, of the second, ...
  std::vector<std::size_t> face_ends_;  ///< how many corners there are up to each face's last
};

/// Cuts concave polygons, too. The triangles of a polygon follow from where its corners are, not
/// from which of them is first or which side it shows.
TriangleMesh triangulated(const PolygonSoup& soup);

}  // namespace lockbox
