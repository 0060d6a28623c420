// SPDX-License-Identifier: BSD-3-Clause
// What is estimated: where the object is, and how its joints stand.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// The pose of the base and the positions of all joints: what is estimated of a frame.
struct Configuration {
  /// The pose of the base's frame in the camera's, metres.
  Eigen::Isometry3d T_camera_base = Eigen::Isometry3d::Identity();
  Eigen::VectorXd q;  ///< one position per joint variable, radians or metres
};

/// Metres of the base from the camera: no depth camera sees an object from farther away, so that
/// positions beyond are in millimetres. Doubled, objects nearer than 4 cm pass in millimetres.
inline constexpr double kFarthestBase = 20.0;

/// Returns all joints at zero (or at the limit nearest to zero), and the base at the camera.
Configuration rest_configuration(const KinematicTree& tree);

/// Returns NaN everywhere, which is what a states file says while nothing is known.
Configuration unknown_configuration(const KinematicTree& tree);

/// Returns the index of the joint. Throws InputError naming the joints that exist if there is none.
int joint_index(const KinematicTree& tree, const std::string& joint_name);

/// Returns the position of a joint by its index, metres or radians, also of one that mimics
/// another.
double joint_position(const KinematicTree& tree, const Configuration& configuration, int joint);

/// Sets the variable that drives the named joint, metres or radians. Throws InputError for a joint
/// that does not exist or mimics another, and for a position that is not finite.
void set_joint_position(const KinematicTree& tree, Configuration& configuration,
                        const std::string& joint_name, double position);

/// Limits of the joint that is variable v. Those of joints that mimic it do not count: elsewhere
/// nobody enforces them, so that they are often wrong.
struct VariableLimits {
  double lower;  ///< radians or metres; -inf if there is none
  double upper;  ///< radians or metres; +inf if there is none
};
VariableLimits variable_limits(const KinematicTree& tree, int variable);

}  // namespace lockbox
