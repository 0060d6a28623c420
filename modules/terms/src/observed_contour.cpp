// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/terms/observed_contour.hpp"

#include <algorithm>

#include "lockbox/kernels/contour_search.hpp"

namespace lockbox {
namespace {

kernels::ContourPose pose_of(const Eigen::Isometry3d& T) {
  kernels::ContourPose pose{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      pose.rotation[3 * row + column] = T.linear()(row, column);
    }
    pose.translation[row] = T.translation()[row];
  }
  return pose;
}

}  // namespace

void ObservedContour::look(std::span<const ContourPoint> points,
                           const Eigen::Isometry3d& T_camera_body, const TiledCloud& cloud,
                           const ViewOptions& options, double annealing_sigma) {
  const std::size_t size = kernels::padded(points.size());
  for (std::vector<double>& array : arrays_) array.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    // What is left of the last lanes repeats the last point.
    const ContourPoint& point = points[std::min(i, points.size() - 1)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      arrays_[px + axis][i] = point.p_body[static_cast<Eigen::Index>(axis)];
      arrays_[nx + axis][i] = point.normal_body[static_cast<Eigen::Index>(axis)];
    }
    arrays_[slope][i] = point.slope;
    arrays_[steepness][i] = point.steepness;
    arrays_[rise][i] = point.rise;
  }
  const auto from = [this](std::size_t number) { return arrays_[number].data(); };
  const PinholeCamera& camera = cloud.camera();
  const SensorNoise& noise = options.noise;
  kernels::search_contours(
      {{from(px), from(py), from(pz)},
       {from(nx), from(ny), from(nz)},
       from(slope),
       from(steepness),
       from(rise),
       points.size()},
      pose_of(T_camera_body),
      {cloud.depth().data(),
       {camera.fx, camera.fy},
       {camera.cx, camera.cy},
       camera.width,
       camera.height},
      {noise.depth_floor, noise.depth_quadratic, noise.lateral_pixels, annealing_sigma,
       options.gate, options.free_space_tolerance, noise.depth_linear},
      {from(offset), from(variance)});
}

}  // namespace lockbox
