// SPDX-License-Identifier: BSD-3-Clause
#include "poses.hpp"

#include <cmath>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox::python {
namespace {

/// Of the product with its transpose from the identity: what was written with four digits passes.
constexpr double kRotationTolerance = 0.01;

/// Of the width or height of an image. Shorter ones see more than 150 degrees, which no depth
/// camera does: they are 1 where they were divided by the size. Doubled, wide cameras are refused.
constexpr double kShortestFocalLength = 0.125;

/// Sizes of the image, from its centre, in which the optical axis is: images that were cut out of
/// larger ones may have it outside. Doubled, less is noticed.
constexpr double kFarthestAxis = 2.0;

bool is_pose(const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  return matrix.allFinite() && rotation.determinant() > 0 &&
         (rotation * rotation.transpose()).isIdentity(kRotationTolerance) &&
         matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1));
}

/// axis: x or y, for the message.
void require_plausible(char axis, double focal_length, double centre, int size) {
  if (focal_length < kShortestFocalLength * size) {
    throw InputError("intrinsics", std::string("f") + axis + " is " + number_text(focal_length) +
                                       " pixels in an image of " + std::to_string(size) +
                                       "; if it was divided by the size of the image, multiply it");
  }
  if (std::abs(centre - 0.5 * size) > kFarthestAxis * size) {
    throw InputError("intrinsics",
                     std::string("c") + axis + " is " + number_text(centre) +
                         ", far outside of an image of " + std::to_string(size) +
                         " pixels; give the camera matrix of images of this size, in pixels");
  }
}

}  // namespace

Eigen::Isometry3d to_pose(const Eigen::Matrix4d& matrix) {
  if (!is_pose(matrix)) {
    const char* const advice = is_pose(matrix.transpose()) ? "; is it transposed?" : "";
    throw InputError("base", std::string("is not a pose: a 4x4 array of a rotation, a translation "
                                         "in metres, and the row 0, 0, 0, 1 is needed") +
                                 advice);
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>()))
                      .normalized()
                      .toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

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

void require_camera(const Eigen::Matrix3d& intrinsics) {
  const bool is_camera = intrinsics.allFinite() && intrinsics(0, 0) > 0 && intrinsics(1, 1) > 0 &&
                         intrinsics(0, 1) == 0 && intrinsics(1, 0) == 0 &&
                         intrinsics.row(2) == Eigen::RowVector3d(0, 0, 1);
  if (!is_camera) {
    throw InputError("intrinsics",
                     "are not a camera matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] in pixels");
  }
}

PinholeCamera to_camera(const Eigen::Matrix3d& intrinsics, int width, int height) {
  require_camera(intrinsics);
  require_plausible('x', intrinsics(0, 0), intrinsics(0, 2), width);
  require_plausible('y', intrinsics(1, 1), intrinsics(1, 2), height);
  return {width, height, intrinsics(0, 0), intrinsics(1, 1), intrinsics(0, 2), intrinsics(1, 2)};
}

Eigen::Matrix3d to_matrix(const PinholeCamera& camera) {
  Eigen::Matrix3d matrix;
  matrix << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return matrix;
}

}  // namespace lockbox::python
