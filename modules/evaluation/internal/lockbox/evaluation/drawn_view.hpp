// SPDX-License-Identifier: BSD-3-Clause
// Random views of a piece of furniture, a board or a thing of a household (object_block.hpp), as
// one meets them.
#pragma once

#include <cstdint>
#include <string>

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/object_block.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {

enum class DrawnKind { furniture, board, household };

struct DrawnView {
  State truth;
  Scene scene;
  /// `wall`: touches it; `floor`: stands before one; `table`: a board lies flat, a thing of a
  /// household stands among others; `air`: it is held there, turned anyhow.
  std::string placement;
  bool is_oblique = false;  ///< from the side and above, as all of a household
  int open = 0;             ///< joints that do not stand at rest
};

/// The view of that object of the block: furniture and boards from 1.2 to 2 m, at most 15 % outside
/// the image; things of a household from 0.5 to 1.1 m, farther if large, among boxes, half of them
/// with a third hidden.
/// Joints stand where no part penetrates another, all at rest or some of them not. The model is
/// that of the object. Throws InputError if no view of it fits.
DrawnView draw_view(DrawnKind kind, const ArticulatedModel& model, const PinholeCamera& camera,
                    const ObjectBlock& block, std::uint64_t number);

/// The same view, to the pixel, of an object `size` times as large: what stands around it, and how
/// far the camera is, grow with it. The tree tells which variables slide. Of the scene, planes and
/// boxes, as `draw_view` places no others.
DrawnView scaled(DrawnView view, const KinematicTree& tree, double size);

/// The sensor with which the object of that number is seen; those of tests are not those of tuning.
std::string draw_sensor(const ObjectBlock& block, std::uint64_t number);

}  // namespace lockbox
