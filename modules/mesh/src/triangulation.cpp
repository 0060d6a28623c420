// SPDX-License-Identifier: BSD-3-Clause
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>

#include <algorithm>

#include "polygon_soup.hpp"

namespace lockbox {
namespace {

bool is_before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// Puts the corner first that is first by its coordinates, and the neighbour second that is;
/// returns whether that turned the polygon round.
bool make_canonical(std::vector<std::uint32_t>& corners,
                    const std::vector<Eigen::Vector3d>& vertices) {
  const auto by_position = [&](std::uint32_t a, std::uint32_t b) {
    return is_before(vertices[a], vertices[b]);
  };
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), by_position),
              corners.end());
  const bool is_turned = by_position(corners.back(), corners[1]);
  if (is_turned) std::reverse(corners.begin() + 1, corners.end());
  return is_turned;
}

class Triangulator {
 public:
  explicit Triangulator(const PolygonSoup& soup) : soup_(soup) { mesh_.vertices = soup.vertices(); }

  void add(std::span<const std::uint32_t> face) {
    if (face.size() == 3) {
      mesh_.triangles.push_back({face[0], face[1], face[2]});
      return;
    }
    corners_.assign(face.begin(), face.end());
    const bool is_turned = make_canonical(corners_, soup_.vertices());
    cut();
    for (vtkIdType i = 0; i + 2 < cut_->GetNumberOfIds(); i += 3) {
      const std::uint32_t a = corner(i);
      const std::uint32_t b = corner(i + 1);
      const std::uint32_t c = corner(i + 2);
      mesh_.triangles.push_back(is_turned ? std::array{a, c, b} : std::array{a, b, c});
    }
  }

  TriangleMesh result() { return std::move(mesh_); }

 private:
  void cut() {
    const auto size = static_cast<vtkIdType>(corners_.size());
    points_->SetNumberOfPoints(size);
    for (vtkIdType i = 0; i < size; ++i) {
      points_->SetPoint(i, soup_.vertices()[corners_[static_cast<std::size_t>(i)]].data());
    }
    polygon_->Initialize(static_cast<int>(size), points_);
    cut_->Reset();
    if (polygon_->Triangulate(cut_) != 0) return;
    // A polygon without area, or one that crosses itself: welding drops the former.
    cut_->Reset();
    for (vtkIdType i = 2; i < size; ++i) {
      for (const vtkIdType id : {vtkIdType{0}, i - 1, i}) cut_->InsertNextId(id);
    }
  }

  std::uint32_t corner(vtkIdType i) const {
    return corners_[static_cast<std::size_t>(cut_->GetId(i))];
  }

  const PolygonSoup& soup_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkPolygon> polygon_;
  vtkNew<vtkIdList> cut_;
};

}  // namespace

TriangleMesh triangulated(const PolygonSoup& soup) {
  Triangulator triangulator(soup);
  for (std::size_t i = 0; i < soup.faces(); ++i) triangulator.add(soup.face(i));
  return triangulator.result();
}

}  // namespace lockbox
