// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "block_tree.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/sdf/build_field.hpp"

namespace lockbox {

/// A box of 0.2 x 0.2 x 0.1 m around the origin, with its field.
inline ArticulatedModel block_model() {
  ArticulatedModel model;
  model.tree = block_tree({0.2, 0.2, 0.1}, {1.0F, 0.0F, 0.0F, 1.0F});
  FieldOptions options;
  options.voxel = 0.005;
  model.fields.emplace_back(build_field(model.tree.bodies[0].mesh, options, Executor(1)));
  return model;
}

/// Its centre one metre before the camera.
inline Configuration one_metre_away() {
  Configuration configuration;
  configuration.T_camera_base.translation().z() = 1.0;
  return configuration;
}

}  // namespace lockbox
