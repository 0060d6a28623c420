// SPDX-License-Identifier: BSD-3-Clause
// Poses of all bodies and their exact derivatives, as functions of (tree, configuration).
//
// The unknowns of a step are (base twist, joint variables): T_camera_base <- T_camera_base exp(xi),
// q <- q + dq. A body's Jacobian maps such a step to the twist of the body, expressed in the body's
// own frame: T_camera_body <- T_camera_body exp(J step) to first order.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "lockbox/core/lie.hpp"
#include "lockbox/model/configuration.hpp"

namespace lockbox {

using BodyPoses = std::vector<Eigen::Isometry3d>;  ///< T_camera_body by body
using BodyJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Writes the poses T_camera_body[b] of all bodies b of the tree. The vector is resized once and
/// then reused.
void forward_kinematics(const KinematicTree& tree, const Configuration& configuration,
                        BodyPoses& T_camera_body);

/// Does the same, but only for those marked by body, each of whose parents is marked, too, or has
/// its pose already. The base keeps its own.
void forward_kinematics_of(const KinematicTree& tree, const Configuration& configuration,
                           std::span<const std::uint8_t> bodies, BodyPoses& T_camera_body);

/// Writes the Jacobian of each body, jacobians[b], 6 x unknowns. It needs the poses that
/// forward_kinematics gave.
void body_jacobians(const KinematicTree& tree, const BodyPoses& T_camera_body,
                    std::vector<BodyJacobian>& jacobians);

/// Writes the Jacobian of the twist of body a relative to body b, expressed in b's frame: T_b_a <-
/// exp(J step) T_b_a. Only joints on the path between the two bodies have columns that are not
/// zero: the base and the joints that carry both are zero by structure, not by cancellation.
void relative_jacobian(const KinematicTree& tree, const BodyPoses& T_camera_body, int a, int b,
                       BodyJacobian& jacobian);

/// Moves the configuration by a step (base twist, joint variables).
void apply_step(const Eigen::VectorXd& step, Configuration& configuration);

/// Returns the configuration after a step.
Configuration stepped(const Configuration& configuration, const Eigen::VectorXd& step);

}  // namespace lockbox
