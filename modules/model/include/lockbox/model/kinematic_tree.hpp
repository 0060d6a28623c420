// SPDX-License-Identifier: BSD-3-Clause
// The constant description of an articulated object: rigid bodies connected by joints, as a tree.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "lockbox/mesh/triangle_mesh.hpp"

namespace lockbox {

/// Unknowns of the base's twist. In a step, its deviations and its gradient they stand before those
/// of the joint variables.
inline constexpr int kBaseUnknowns = 6;

/// Returns where a joint variable stands among the unknowns.
constexpr int unknown_of(int variable) {
  return kBaseUnknowns + variable;
}

enum class JointType { revolute, continuous, prismatic };

/// A movable joint. Fixed joints do not exist here: the bodies that they connect are one body.
struct Joint {
  std::string name;                      ///< as in the file
  JointType type = JointType::revolute;  ///< how it moves
  int parent_body = 0;                   ///< index into KinematicTree::bodies
  int child_body = 0;                    ///< index into KinematicTree::bodies
  Eigen::Isometry3d T_parent_joint = Eigen::Isometry3d::Identity();  ///< at position 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();                   ///< unit, joint frame
  double lower = 0.0;       ///< limits, radians or metres; -inf and +inf for continuous joints
  double upper = 0.0;       ///< the same at the other end
  int variable = -1;        ///< index of the joint variable that drives it
  double multiplier = 1.0;  ///< position = multiplier * variable + offset (1, 0 unless mimic)
  double offset = 0.0;      ///< radians or metres
  bool is_mimic = false;    ///< whether another joint drives it
};

/// Triangles of one colour, in the frame of the body.
struct ColoredMesh {
  TriangleMesh mesh;                             ///< in metres
  Eigen::Vector4f rgba{0.7F, 0.7F, 0.7F, 1.0F};  ///< red, green, blue, opacity in [0, 1]
};

/// One rigid body: a URDF link with all that fixed joints attach to it.
struct Body {
  std::string name;                  ///< of the link nearest to the root
  std::vector<std::string> links;    ///< all URDF links that it is made of
  std::vector<ColoredMesh> visuals;  ///< empty for a mere frame
  TriangleMesh mesh;                 ///< all visuals together, body frame, metres
  int parent_joint = -1;             ///< -1 for the base
  bool encloses_solid = false;       ///< whether the mesh is known to, see mesh_audit.hpp
};

/// Bodies in depth-first order from the base (body 0); joint j moves body j + 1. Among siblings the
/// order follows from what they are (placement, axis, shape), not from their names or from the
/// file, so that no result can depend on how the file was written.
struct KinematicTree {
  std::string name;           ///< of the robot in the URDF, or the stem of the mesh file
  std::vector<Body> bodies;   ///< the base first
  std::vector<Joint> joints;  ///< joints[j] carries bodies[j + 1]
  /// The joints that mimic no other, in the order of joints: joints[variable_joint[v]] is driven by
  /// variable v of a Configuration.
  std::vector<int> variable_joint;
  /// Indices into joints in the order of the file: the columns of a states file.
  std::vector<int> file_order;

  /// Returns how many joint variables a configuration has.
  int variables() const { return static_cast<int>(variable_joint.size()); }
  /// Returns how many unknowns a step has: the base's twist, then the joint variables.
  int unknowns() const { return unknown_of(variables()); }
};

}  // namespace lockbox
