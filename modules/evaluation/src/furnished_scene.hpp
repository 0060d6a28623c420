// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "lockbox/simulation/random_draws.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox::evaluation {

/// A room as people live in it, seen by somebody who stands or sits.
struct FurnishedScene {
  Scene scene;  ///< in its base frame: x right, y up, z out of the back wall; y = 0 is the floor
  Eigen::Isometry3d T_camera_base;
  std::string content;  ///< the pieces, joined by '+'
};

/// Floor, back wall, mostly a side wall, and two to four of: table, shelf, cupboard, person.
FurnishedScene draw_furnished_scene(RandomDraws& random);

}  // namespace lockbox::evaluation
