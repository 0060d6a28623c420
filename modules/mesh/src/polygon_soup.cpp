// SPDX-License-Identifier: BSD-3-Clause
#include "polygon_soup.hpp"

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

/// Ten million triangles as an STL file has them, about a gigabyte while a mesh is made of them.
/// Scans of single objects have less than a tenth.
constexpr std::size_t kMostCorners = 30'000'000;
/// The time to cut a polygon grows with the square; for this many it is about a second.
constexpr std::size_t kMostCornersOfFace = 10'000;

}  // namespace

void PolygonSoup::add_vertex(const Eigen::Vector3d& vertex) {
  if (vertices_.size() >= kMostCorners) {
    throw InputError(file_, "the mesh has more than 30 million vertices; simplify it");
  }
  vertices_.push_back(vertex);
}

void PolygonSoup::add_corner(std::uint32_t vertex) {
  if (corners_.size() >= kMostCorners) {
    throw InputError(file_, "the mesh has more than 10 million triangles; simplify it");
  }
  if (corners_.size() - face_begin() >= kMostCornersOfFace) {
    throw InputError(file_, "face " + std::to_string(faces() + 1) +
                                " has more than 10000 corners; cut it into triangles");
  }
  corners_.push_back(vertex);
}

void PolygonSoup::end_face() {
  if (corners_.size() - face_begin() < 3) {
    corners_.resize(face_begin());
  } else {
    face_ends_.push_back(corners_.size());
  }
}

}  // namespace lockbox
