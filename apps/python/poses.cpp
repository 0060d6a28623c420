// SPDX-License-Identifier: BSD-3-Clause
#include "poses.hpp"

#include "lockbox/core/error.hpp"

namespace lockbox::python {
namespace {

/// Of the product with its transpose from the identity: what was written with four digits passes.
constexpr double kRotationTolerance = 0.01;

Eigen::Isometry3d to_pose(const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const bool is_rotation = (rotation * rotation.transpose()).isIdentity(kRotationTolerance) &&
                           rotation.determinant() > 0;
  const bool is_affine = matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1));
  if (!matrix.allFinite() || !is_rotation || !is_affine) {
    throw InputError("base",
                     "is not a pose: a 4x4 array of a rotation, a translation in metres, and the "
                     "row 0, 0, 0, 1 is needed");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

}  // namespace

Configuration to_configuration(const KinematicTree& tree, const State& state) {
  Configuration configuration = rest_configuration(tree);
  configuration.T_camera_base = to_pose(state.base);
  for (const auto& [name, position] : state.joints) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(joint_index(tree, name))];
    // States that were read from a result have them; they follow the joint that drives them.
    if (!joint.is_mimic) set_joint_position(tree, configuration, name, position);
  }
  return configuration;
}

State to_state(const KinematicTree& tree, const Configuration& configuration) {
  State state;
  state.base = configuration.T_camera_base.matrix();
  for (const int joint : tree.file_order) {
    state.joints.emplace_back(tree.joints[static_cast<std::size_t>(joint)].name,
                              joint_position(tree, configuration, joint));
  }
  return state;
}

std::vector<int> variables_of_file(const KinematicTree& tree) {
  std::vector<int> variables;
  for (const int index : tree.file_order) {
    const Joint& joint = tree.joints[static_cast<std::size_t>(index)];
    if (!joint.is_mimic) variables.push_back(joint.variable);
  }
  return variables;
}

py::dict to_dict(const JointValues& values) {
  py::dict result;
  for (const auto& [name, value] : values) result[py::str(name)] = value;
  return result;
}

PinholeCamera to_camera(const Eigen::Matrix3d& intrinsics, int width, int height) {
  const bool is_camera = intrinsics.allFinite() && intrinsics(0, 0) > 0 && intrinsics(1, 1) > 0 &&
                         intrinsics(0, 1) == 0 && intrinsics(1, 0) == 0 &&
                         intrinsics.row(2) == Eigen::RowVector3d(0, 0, 1);
  if (!is_camera) {
    throw InputError("intrinsics",
                     "are not a camera matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] in pixels");
  }
  return {width, height, intrinsics(0, 0), intrinsics(1, 1), intrinsics(0, 2), intrinsics(1, 2)};
}

Eigen::Matrix3d to_matrix(const PinholeCamera& camera) {
  Eigen::Matrix3d matrix;
  matrix << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return matrix;
}

}  // namespace lockbox::python
