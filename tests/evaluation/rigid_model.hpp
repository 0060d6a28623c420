// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sdf/build_field.hpp"

namespace lockbox {

/// A body without joints.
inline KinematicTree rigid_tree(const TriangleMesh& mesh) {
  KinematicTree tree;
  tree.name = "rigid";
  Body body;
  body.name = "body";
  body.mesh = mesh;
  body.visuals.push_back({mesh, Eigen::Vector4f::Ones()});
  tree.bodies.push_back(body);
  return tree;
}

/// The same with its distance field.
inline ArticulatedModel rigid(const TriangleMesh& mesh) {
  ArticulatedModel model;
  model.tree = rigid_tree(mesh);
  FieldOptions options;
  options.voxel = 0.002;
  model.fields.emplace_back(build_field(mesh, options, Executor(1)));
  return model;
}

}  // namespace lockbox
