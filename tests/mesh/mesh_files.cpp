// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_files.hpp"

#include <cstdint>
#include <sstream>

#include "lockbox/mesh/primitives.hpp"

namespace lockbox {
namespace {

const TriangleMesh& box() {
  static const TriangleMesh mesh = make_box({0.2, 0.1, 0.05});
  return mesh;
}

template <typename T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, const Eigen::Vector3d& p) {
  for (const double coordinate : p) {
    put(bytes, static_cast<float>(coordinate));
  }
}

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment a box\nelement vertex 8\nproperty float x\nproperty float y\n"
         "property float z\nelement face 12\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

std::string box_as_obj() {
  std::ostringstream text;
  text << "# a box\no box\n";
  for (const Eigen::Vector3d& vertex : box().vertices) {
    text << "v " << vertex.transpose() << "\n";
  }
  for (const auto& [a, b, c] : box().triangles) {
    text << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  }
  return text.str();
}

std::string box_as_text_stl() {
  std::ostringstream text;
  text << "solid box\n";
  for (std::size_t t = 0; t < box().triangles.size(); ++t) {
    text << " facet normal 0 0 0\n  outer loop\n";
    for (const Eigen::Vector3d& corner : box().corners(t)) {
      text << "   vertex " << corner.transpose() << "\n";
    }
    text << "  endloop\n endfacet\n";
  }
  text << "endsolid box\n";
  return text.str();
}

std::string box_as_binary_stl() {
  std::string bytes = "solid in name only";
  bytes.resize(80, ' ');
  put(bytes, static_cast<std::uint32_t>(box().triangles.size()));
  for (std::size_t t = 0; t < box().triangles.size(); ++t) {
    put(bytes, Eigen::Vector3d(0, 0, 0));
    for (const Eigen::Vector3d& corner : box().corners(t)) {
      put(bytes, corner);
    }
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string box_as_text_ply() {
  std::ostringstream text;
  text << ply_header("ascii");
  for (const Eigen::Vector3d& vertex : box().vertices) {
    text << vertex.transpose() << "\n";
  }
  for (const auto& [a, b, c] : box().triangles) {
    text << "3 " << a << " " << b << " " << c << "\n";
  }
  return text.str();
}

std::string box_as_binary_ply() {
  std::string bytes = ply_header("binary_little_endian");
  for (const Eigen::Vector3d& vertex : box().vertices) {
    put(bytes, vertex);
  }
  for (const auto& triangle : box().triangles) {
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) {
      put(bytes, static_cast<std::int32_t>(vertex));
    }
  }
  return bytes;
}

}  // namespace lockbox
