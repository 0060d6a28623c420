// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/core/pinhole_camera.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/random_draws.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox::evaluation {

struct FreeFormScene {
  State truth;
  Scene scene;
  bool on_table = false;    ///< or in the air, turned anyhow
  bool is_covered = false;  ///< by a box before it
  double hidden = 0.0;      ///< share of its view
};

/// The object among boxes, on a table or in the air, 0.5 to 1.1 m away, farther if it is larger
/// than half a metre; a box hides about a third of every other one. Joints stand anywhere where no
/// part penetrates another. Throws InputError if no view of it fits.
FreeFormScene draw_free_form_scene(const ArticulatedModel& model, const PinholeCamera& camera,
                                   RandomDraws random);

/// The same, of joints that stand as given.
FreeFormScene draw_free_form_scene(const ArticulatedModel& model, const PinholeCamera& camera,
                                   const Configuration& joints, RandomDraws random);

}  // namespace lockbox::evaluation
