// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/mesh/primitives.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// One body: a box of the given size (metres) around the origin, in one colour.
inline KinematicTree block_tree(const Eigen::Vector3d& size, const Eigen::Vector4f& rgba) {
  KinematicTree tree;
  Body body;
  body.name = "block";
  body.mesh = make_box(size);
  body.visuals.push_back({body.mesh, rgba});
  tree.bodies.push_back(body);
  return tree;
}

}  // namespace lockbox
