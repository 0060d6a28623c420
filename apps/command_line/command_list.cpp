// SPDX-License-Identifier: BSD-3-Clause
#include "command_list.hpp"

#include <algorithm>

namespace lockbox::app {

const std::vector<CommandEntry>& command_list() {
  static const std::vector<CommandEntry> entries = {
      {"track", "Estimates base pose and joints for every frame of a source",
       "lockbox track --model lockbox --source recording.oni --output out/run"},
      {"simulate", "Renders what a depth camera would record of a moving model",
       "lockbox simulate --model lockbox --trajectory states.csv --output recording.oni"},
      {"record", "Records a live device, or a recording of any kind, into an .oni file",
       "lockbox record --source openni2: --output recording.oni"},
      {"evaluate", "Compares estimated states with a reference",
       "lockbox evaluate --estimate out/run/states.csv --reference groundtruth.csv "
       "--output out/errors"},
      {"experiment", "Repeats an experiment of the project, with raw results and figures",
       "lockbox experiment rigid --output out/rigid"},
      {"inspect", "Shows a model: its tree, distance fields, contacts, and a picture",
       "lockbox inspect --model lockbox --picture lockbox.png"},
      {"view", "Shows a model, a live device, or a recorded run in a 3D window",
       "lockbox view --model lockbox --source recording.oni --states out/run/states.csv"},
      {"devices", "Lists the depth cameras that OpenNI2 sees, or says why there is none",
       "lockbox devices --uri virtual-depth:/tmp/camera"},
      {"cache", "Tells what the cache of distance fields holds, or clears it",
       "lockbox cache --clear"},
  };
  return entries;
}

const CommandEntry* find_command(const std::string& name) {
  const auto& entries = command_list();
  const auto entry =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.name == name; });
  return entry != entries.end() ? &*entry : nullptr;
}

}  // namespace lockbox::app
