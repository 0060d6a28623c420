// SPDX-License-Identifier: BSD-3-Clause
// Random views of an object that nobody has aimed at: pose, joints, surroundings.
#pragma once

#include <cstdint>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {

enum class Placement {
  free,      ///< held in the air, or on something out of view
  on_table,  ///< its lower side (-y of the base) touches a table
  on_wall    ///< its back (-z of the base) touches a wall
};

struct RandomScene {
  State truth;
  Scene scene;
  Placement placement = Placement::free;
  bool cut_off = false;  ///< part of the object lies outside the image
  double visible = 1.0;  ///< share of its view that is in the image and unoccluded
};

/// The ranges from which scenes are drawn. The front of an object is where its base's z axis
/// points, its centre the middle of that side of its bounds at rest.
struct RandomSceneOptions {
  double min_distance = 0.7;  ///< of the front's centre from the camera, metres
  double max_distance = 2.5;
  double max_tilt = 1.0471976;  ///< between the front's normal and the way to the camera, radians
  double least_visible = 0.4;   ///< of the object's view, in the image and unoccluded
  double cut_off_share = 0.3;   ///< of the scenes
  double on_wall_share = 0.2;
  double on_table_share = 0.4;
  double arm_share = 0.3;  ///< with a person's arm in view
};

/// The scene with that number: it follows from the seed and the number alone. Joints stand anywhere
/// within their limits where no part penetrates another. Throws InputError if the options leave no
/// room for the model.
RandomScene draw_random_scene(const ArticulatedModel& model, const PinholeCamera& camera,
                              std::uint64_t seed, std::uint64_t number,
                              const RandomSceneOptions& options = {});

/// Draws a scene likewise, around something else that stands there instead: `built` has the joints
/// of the model, which stand where the model's parts do not penetrate each other, or none at all.
RandomScene draw_random_scene(const ArticulatedModel& model, const KinematicTree& built,
                              const PinholeCamera& camera, std::uint64_t seed, std::uint64_t number,
                              const RandomSceneOptions& options = {});

}  // namespace lockbox
