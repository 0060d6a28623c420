// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/viewpoint.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// All vertices in the frame of the base, whatever the pose of the base.
std::vector<Eigen::Vector3d> vertices_in_base(const KinematicTree& tree,
                                              Configuration configuration) {
  configuration.T_camera_base.setIdentity();
  std::vector<Eigen::Isometry3d> T_base_body;
  forward_kinematics(tree, configuration, T_base_body);
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t body = 0; body < tree.bodies.size(); ++body) {
    for (const auto& vertex : tree.bodies[body].mesh.vertices) {
      vertices.push_back(T_base_body[body] * vertex);
    }
  }
  return vertices;
}

/// The distance from which a point is inside the picture, the camera looking at the centre.
double distance_to_see(const Eigen::Vector3d& from_centre, double tan_x, double tan_y) {
  return std::max(std::abs(from_centre.x()) / tan_x, std::abs(from_centre.y()) / tan_y) -
         from_centre.z();
}

}  // namespace

Viewpoint overview(const KinematicTree& tree, const Configuration& configuration, int width,
                   int height) {
  constexpr double kFocalLengthPerWidth = 1.4;
  constexpr double kMargin = 1.06;
  constexpr double kFromTheSide = 0.45;  // radians
  constexpr double kFromAbove = 0.5;
  const double focal = kFocalLengthPerWidth * width;
  Viewpoint view;
  view.camera = {width, height, focal, focal, 0.5 * (width - 1), 0.5 * (height - 1)};

  // The camera looks against the base's z axis; its y axis points down.
  const Eigen::Matrix3d facing = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  const Eigen::Matrix3d R_camera_base =
      Eigen::AngleAxisd(kFromAbove, Eigen::Vector3d::UnitX()).toRotationMatrix() *
      Eigen::AngleAxisd(kFromTheSide, Eigen::Vector3d::UnitY()).toRotationMatrix() * facing;

  const auto vertices = vertices_in_base(tree, configuration);
  Eigen::AlignedBox3d box;
  for (const auto& vertex : vertices) box.extend(R_camera_base * vertex);
  const Eigen::Vector3d centre = box.center();  // zero without vertices
  double distance = 0.0;
  for (const auto& vertex : vertices) {
    distance = std::max(distance, distance_to_see(R_camera_base * vertex - centre,
                                                  0.5 * width / focal, 0.5 * height / focal));
  }
  view.T_camera_base.setIdentity();
  view.T_camera_base.linear() = R_camera_base;
  view.T_camera_base.translation() = Eigen::Vector3d(0.0, 0.0, kMargin * distance) - centre;
  return view;
}

}  // namespace lockbox
