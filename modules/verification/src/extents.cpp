// SPDX-License-Identifier: BSD-3-Clause
#include "extents.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr double kSameWay = 0.95;  // cosine of 18 degrees: short lines are known no better
constexpr double kCells = 1.5;     // by which a line is drawn off
constexpr int kLeastCells = 25;    // of five in a row across, for its direction to be known
constexpr double kGrazing = 0.2;   // sine: less of a face tells nothing
constexpr int kBeside = 3;         // cells
constexpr std::pair<int, int> kNone{-1, -1};
constexpr double kElongated = 4.0;  // variances along a line and across it that tell its direction

Eigen::Vector3d point_of(const SceneCells& scene, std::span<const float> cells, int u, int v) {
  return scene.camera().back_project(u, v, 1.0 / static_cast<double>(cells[scene.index(u, v)]));
}

}  // namespace

/// Seen from either of them, the other is no farther than the less certain one may be off.
bool Extents::Plane::is_same(const Plane& other) const {
  const Eigen::Vector3d apart = other.point - point;
  const double within = std::max(tolerance, other.tolerance);
  return outward.dot(other.outward) > kSameWay && std::abs(outward.dot(apart)) < within &&
         std::abs(other.outward.dot(apart)) < within;
}

void Extents::add(const SceneCells& scene, std::span<const float> cells, int u, int v,
                  const Eigen::Vector2f& direction, Line& line) const {
  const Eigen::Vector2d cell(u, v);
  line.cells += cell;
  line.squares += cell * cell.transpose();
  line.way += direction.cast<double>();
  const Eigen::Vector3d here = point_of(scene, cells, u, v);
  line.points += here;
  ++line.count;
  // The face is seen on the side from which the line is looked at.
  const int du = direction.x() > 0.0F ? -1 : 1;
  const int dv = direction.y() > 0.0F ? -1 : 1;
  if (!scene.contains(u + du, v + dv) || !(cells[scene.index(u + du, v)] > 0.0F) ||
      !(cells[scene.index(u, v + dv)] > 0.0F)) {
    return;
  }
  const Eigen::Vector3d normal = (point_of(scene, cells, u + du, v) - here)
                                     .cross(point_of(scene, cells, u, v + dv) - here)
                                     .normalized();
  line.normal += normal.dot(here) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

/// A line of the image and the camera lie in a plane; where it meets the face, the face ends.
Extents::Plane Extents::plane_of(const SceneCells& scene, const Line& line) const {
  const Eigen::Vector2d middle = line.cells / line.count;
  const Eigen::Matrix2d covariance = line.squares / line.count - middle * middle.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  Eigen::Vector2d way = line.way.normalized();
  if (axes.eigenvalues()[1] > kElongated * axes.eigenvalues()[0]) {
    const Eigen::Vector2d across = axes.eigenvectors().col(0);
    way = across.dot(way) < 0.0 ? Eigen::Vector2d(-across) : across;
  }
  const PinholeCamera& camera = scene.camera();
  const Eigen::Vector3d at = camera.back_project(middle.x(), middle.y(), 1.0);
  const Eigen::Vector2d slope(way.x() * camera.fx, way.y() * camera.fy);
  const Eigen::Vector3d sight(slope.x(), slope.y(), -slope.dot(at.head<2>()));
  const Eigen::Vector3d normal = line.normal.normalized();
  const Eigen::Vector3d outward = (sight - normal * normal.dot(sight)).normalized();
  const Eigen::Vector3d point = line.points / line.count;
  return {outward, point, 0.0};
}

void Extents::find(const SceneCells& scene, std::span<const float> cells, const ContourLines& lines,
                   double tolerance) {
  found_.assign(static_cast<std::size_t>(lines.count()), {});
  const auto for_each_cell = [&](const auto& call) {
    for (int v = 0; v < scene.height(); ++v) {
      for (int u = 0; u < scene.width(); ++u) {
        const std::size_t cell = scene.index(u, v);
        if (!lines.direction(cell).isZero()) {
          call(u, v, lines.direction(cell), static_cast<std::size_t>(lines.line(cell)));
        }
      }
    }
  };
  for_each_cell([&](int u, int v, const Eigen::Vector2f& direction, std::size_t line) {
    add(scene, cells, u, v, direction, found_[line]);
  });
  ends_.clear();
  for (const Line& line : found_) ends_.push_back(plane_of(scene, line));
  farthest_.assign(found_.size(), 0.0);
  for_each_cell([&](int u, int v, const Eigen::Vector2f&, std::size_t line) {
    const Plane& end = ends_[line];
    farthest_[line] =
        std::max(farthest_[line], end.outward.dot(point_of(scene, cells, u, v) - end.point));
  });
  planes_.clear();
  of_line_.assign(found_.size(), kNone);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (found_[i].count >= kLeastCells) of_line_[i] = planes_of(i, scene, tolerance);
  }
  for_each_cell([&](int u, int v, const Eigen::Vector2f&, std::size_t line) {
    if (of_line_[line] == kNone) of_line_[line] = planes_beside(scene, lines, u, v);
  });
  for (std::size_t i = 0; i < found_.size(); ++i) {
    if (of_line_[i] == kNone) of_line_[i] = planes_of(i, scene, tolerance);
  }
}

std::pair<int, int> Extents::planes_of(std::size_t line, const SceneCells& scene,
                                       double tolerance) {
  const Plane& end = ends_[line];
  // A cell shows more of a face that is seen at a grazing angle.
  const double cell = end.point.z() / scene.camera().fx;
  const double foreshortened = end.outward.cross(end.point.normalized()).norm();
  const double within = tolerance + kCells * cell / std::max(kGrazing, foreshortened);
  const Plane reach{end.outward, end.point + farthest_[line] * end.outward, within};
  const Plane face{found_[line].normal.normalized(), end.point, within};
  return {extent_of(reach), extent_of(face)};
}

int Extents::extent_of(const Plane& plane) {
  const auto same = std::find_if(planes_.begin(), planes_.end(),
                                 [&](const Plane& other) { return other.is_same(plane); });
  if (same != planes_.end()) return static_cast<int>(same - planes_.begin());
  planes_.push_back(plane);
  return count() - 1;
}

/// What is too short for its direction to be known is of the line that it is a piece of.
std::pair<int, int> Extents::planes_beside(const SceneCells& scene, const ContourLines& lines,
                                           int u, int v) const {
  for (int dv = -kBeside; dv <= kBeside; ++dv) {
    for (int du = -kBeside; du <= kBeside; ++du) {
      if (!scene.contains(u + du, v + dv)) continue;
      const std::size_t cell = scene.index(u + du, v + dv);
      if (lines.direction(cell).isZero()) continue;
      const auto line = static_cast<std::size_t>(lines.line(cell));
      if (found_[line].count >= kLeastCells) return of_line_[line];
    }
  }
  return kNone;
}

}  // namespace lockbox
