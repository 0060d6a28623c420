// SPDX-License-Identifier: BSD-3-Clause
#include "experiments.hpp"

namespace lockbox::app {

const std::vector<ExperimentEntry>& experiments() {
  static const std::vector<ExperimentEntry> entries = {
      {"convergence", "How wrong a start may be, in translation and rotation",
       make_convergence_experiment},
      {"rigid", "Starts displaced along a box that is only partly in view", make_rigid_experiment},
      {"intersection", "What the collision term does to the joints", make_intersection_experiment},
      {"order", "Nothing depends on the order or the names of links", make_order_experiment},
      {"global", "Random scenes, searched without a guess", make_global_experiment},
      {"kidnap", "The box is moved unseen, or the estimate is thrown away", make_kidnap_experiment},
      {"occlusion", "An arm sweeps over the box", make_occlusion_experiment},
      {"speed", "Faster and faster motion, and sudden steps", make_speed_experiment},
      {"accuracy", "Single frames, against what the sensor's noise allows",
       make_accuracy_experiment},
      {"creep", "One image again and again: what is not determined rests", make_creep_experiment},
      {"mismatch", "Objects unlike their models, cameras unlike their calibrations",
       make_mismatch_experiment},
      {"absent", "Rooms without the object: whatever is found is a false alarm",
       make_absent_experiment},
      {"furniture", "Random drawers and doors that nobody tuned for, found without a guess",
       make_furniture_experiment},
      {"boards", "Random puzzle boards that nobody tuned for, found without a guess",
       make_boards_experiment},
      {"household", "Random things that fold, open, turn or slide, found without a guess",
       make_household_experiment},
      {"shapes", "Random round and free-form objects, found without a guess",
       make_shapes_experiment},
      {"reliability", "Whether what is believed by so much is right so often",
       make_reliability_experiment},
      {"peers", "The scene on which M3T was measured, beside its figures", make_peers_experiment},
  };
  return entries;
}

}  // namespace lockbox::app
