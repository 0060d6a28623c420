// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

namespace lockbox::app {

const std::vector<CommandEntry>& commands() {
  static const std::vector<CommandEntry> entries = {
      {"track", "Estimates base pose and joints for every frame of a source",
       "lockbox track --model lockbox --source recording.oni --output out/run", make_track_command},
      {"simulate", "Renders what a depth camera would record of a moving model",
       "lockbox simulate --model lockbox --trajectory states.csv --output recording.oni",
       make_simulate_command},
      {"record", "Records a live device, or a recording of any kind, into an .oni file",
       "lockbox record --source openni2: --output recording.oni", make_record_command},
      {"evaluate", "Compares estimated states with a reference",
       "lockbox evaluate --estimate out/run/states.csv --reference groundtruth.csv "
       "--output out/errors",
       make_evaluate_command},
      {"experiment", "Repeats an experiment of the project, with raw results and figures",
       "lockbox experiment rigid --output out/rigid", make_experiment_command},
      {"inspect", "Shows a model: its tree, distance fields, contacts, and a picture",
       "lockbox inspect --model lockbox --picture lockbox.png", make_inspect_command},
      {"view", "Shows a model, a live device, or a recorded run in a 3D window",
       "lockbox view --model lockbox --source recording.oni --states out/run/states.csv",
       make_view_command},
      {"devices", "Lists the depth cameras that OpenNI2 sees, or says why there is none",
       "lockbox devices --uri virtual-depth:/tmp/camera", make_devices_command},
      {"cache", "Tells what the cache of distance fields holds, or clears it",
       "lockbox cache --clear", make_cache_command},
  };
  return entries;
}

}  // namespace lockbox::app
