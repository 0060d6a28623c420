// SPDX-License-Identifier: BSD-3-Clause
// Up to where the faces of an object reach. Who builds one puts edges into common planes: the front
// and the side of a box end at the same height. Where one of them ends is no news once it is known
// of the other.
#pragma once

#include <Eigen/Core>
#include <span>
#include <utility>
#include <vector>

#include "contour_lines.hpp"
#include "scene_cells.hpp"

namespace lockbox {

/// Reuses its buffers.
class Extents {
 public:
  /// Joins the model's contour lines at which faces end in one plane, looking the same way. cells:
  /// what the model shows, 1/metre, 0 where nothing. tolerance: metres within which planes are one.
  void find(const SceneCells& scene, std::span<const float> cells, const ContourLines& lines,
            double tolerance);

  int count() const { return static_cast<int>(planes_.size()); }
  /// The two planes that meet in a line of the model.
  std::pair<int, int> of_line(int line) const { return of_line_[static_cast<std::size_t>(line)]; }

 private:
  /// Sums over the cells of a line.
  struct Line {
    Eigen::Vector2d cells = Eigen::Vector2d::Zero();
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    Eigen::Vector2d way = Eigen::Vector2d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the face
    Eigen::Vector3d points = Eigen::Vector3d::Zero();
    int count = 0;
  };
  /// A face ends there.
  struct Plane {
    Eigen::Vector3d outward;
    Eigen::Vector3d point;
    double tolerance;

    bool is_same(const Plane& other) const;
  };

  void add(const SceneCells& scene, std::span<const float> cells, int u, int v,
           const Eigen::Vector2f& direction, Line& line) const;
  Plane plane_of(const SceneCells& scene, const Line& line) const;
  int extent_of(const Plane& plane);
  std::pair<int, int> planes_beside(const SceneCells& scene, const ContourLines& lines, int u,
                                    int v) const;
  std::pair<int, int> planes_of(std::size_t line, const SceneCells& scene, double tolerance);

  std::vector<Line> found_;
  std::vector<Plane> ends_;       ///< by line
  std::vector<double> farthest_;  ///< by line: of its cells, beyond its point
  std::vector<Plane> planes_;
  std::vector<std::pair<int, int>> of_line_;
};

}  // namespace lockbox
