// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// What the joint does at the given position.
Eigen::Isometry3d joint_motion(const Joint& joint, double position) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (joint.type == JointType::prismatic) {
    T.translation() = position * joint.axis;
  } else {
    T.linear() = Eigen::AngleAxisd(position, joint.axis).toRotationMatrix();
  }
  return T;
}

/// Twist of the child body, in its own frame, as the variable that drives the joint changes.
Twist variable_twist(const Joint& joint) {
  Twist twist = Twist::Zero();
  if (joint.type == JointType::prismatic) {
    twist.head<3>() = joint.multiplier * joint.axis;
  } else {
    twist.tail<3>() = joint.multiplier * joint.axis;
  }
  return twist;
}

void place_child(const Joint& joint, const Configuration& configuration, BodyPoses& T_camera_body) {
  const double position = joint.multiplier * configuration.q[joint.variable] + joint.offset;
  T_camera_body[index(joint.child_body)] = T_camera_body[index(joint.parent_body)] *
                                           joint.T_parent_joint * joint_motion(joint, position);
}

}  // namespace

void forward_kinematics(const KinematicTree& tree, const Configuration& configuration,
                        std::vector<Eigen::Isometry3d>& T_camera_body) {
  T_camera_body.resize(tree.bodies.size());
  T_camera_body[0] = configuration.T_camera_base;
  for (const Joint& joint : tree.joints) place_child(joint, configuration, T_camera_body);
}

void forward_kinematics_of(const KinematicTree& tree, const Configuration& configuration,
                           std::span<const std::uint8_t> bodies, BodyPoses& T_camera_body) {
  if (bodies[0] != 0) T_camera_body[0] = configuration.T_camera_base;
  for (const Joint& joint : tree.joints) {
    if (bodies[index(joint.child_body)] != 0) place_child(joint, configuration, T_camera_body);
  }
}

void body_jacobians(const KinematicTree& tree, const std::vector<Eigen::Isometry3d>& T_camera_body,
                    std::vector<BodyJacobian>& jacobians) {
  jacobians.resize(tree.bodies.size());
  jacobians[0].setZero(6, tree.unknowns());
  jacobians[0].leftCols<6>().setIdentity();
  for (const Joint& joint : tree.joints) {
    const Eigen::Isometry3d T_child_parent =
        T_camera_body[index(joint.child_body)].inverse() * T_camera_body[index(joint.parent_body)];
    BodyJacobian& child = jacobians[index(joint.child_body)];
    child.noalias() = adjoint(T_child_parent).lazyProduct(jacobians[index(joint.parent_body)]);
    child.col(unknown_of(joint.variable)) += variable_twist(joint);
  }
}

void relative_jacobian(const KinematicTree& tree,
                       const std::vector<Eigen::Isometry3d>& T_camera_body, int a, int b,
                       BodyJacobian& jacobian) {
  jacobian.setZero(6, tree.unknowns());
  const Eigen::Isometry3d T_b_camera = T_camera_body[index(b)].inverse();
  // A parent's index is smaller than its child's, so the larger of the two is never above the
  // other.
  while (a != b) {
    const bool moves_a = a > b;
    int& body = moves_a ? a : b;
    const Joint& joint = tree.joints[index(tree.bodies[index(body)].parent_joint)];
    const Twist in_b = adjoint(T_b_camera * T_camera_body[index(body)]) * variable_twist(joint);
    jacobian.col(unknown_of(joint.variable)) += moves_a ? in_b : Twist(-in_b);
    body = joint.parent_body;
  }
}

void apply_step(const Eigen::VectorXd& step, Configuration& configuration) {
  configuration.T_camera_base = configuration.T_camera_base * exp_se3(step.head<6>());
  configuration.q += step.tail(configuration.q.size());
}

Configuration stepped(const Configuration& configuration, const Eigen::VectorXd& step) {
  Configuration result = configuration;
  apply_step(step, result);
  return result;
}

}  // namespace lockbox
