// SPDX-License-Identifier: BSD-3-Clause
#include "command_list.hpp"

#include <algorithm>

namespace lockbox::app {

const std::vector<CommandEntry>& command_list() {
  static const std::vector<CommandEntry> entries = {
      {"track", "Estimates base pose and joints for every frame of a source",
       "Searches the object in the first frame, unless a start is given, and follows it from "
       "there. Each frame gets a pose of the base, a position of each joint, how uncertain "
       "they are, and a status: `tracking`, `uncertain`, `lost`, or `initializing`. With "
       "--output they are written into a folder.",
       "lockbox track --model lockbox --source recording.oni --output out/run"},
      {"simulate", "Renders what a depth camera would record of a moving model",
       "Draws the model as it moves along a trajectory, alone or in a scene, with the noise "
       "of a sensor, and writes a recording or a folder of depth images. The truth is "
       "written beside it.",
       "lockbox simulate --model lockbox --trajectory states.csv --output recording.oni"},
      {"record", "Records a live device, or a recording of any kind, into an .oni file",
       "Writes the frames of a source into an .oni file, which OpenNI2 and all commands of "
       "lockbox read. Ctrl-C ends a live recording, which is complete then.",
       "lockbox record --source openni2: --output recording.oni"},
      {"evaluate", "Compares estimated states with a reference",
       "Matches rows of the same time, and tells by how much base and joints differ: "
       "quantiles over all frames, and how many are right. With --output every error is "
       "written.",
       "lockbox evaluate --estimate out/run/states.csv --reference groundtruth.csv "
       "--output out/errors"},
      {"experiment", "Repeats an experiment of the project, with raw results and figures",
       "Each experiment is a subcommand with options of its own. It simulates recordings, "
       "has them tracked, and writes raw results and figures into a folder; the same seed "
       "gives the same results.",
       "lockbox experiment rigid --output out/rigid"},
      {"inspect", "Shows a model: its tree, distance fields, contacts, and a picture",
       "Reads a model as the other commands do, and says what is in it, and what is odd "
       "about it: sizes, open meshes, joints, parts that touch at rest.",
       "lockbox inspect --model lockbox --picture lockbox.png"},
      {"view", "Shows a model, a live device, or a recorded run in a 3D window",
       "Opens a window in which a recorded run plays, the mouse turns the view, and keys "
       "choose what is shown; the key h lists them. A model alone has sliders that move its "
       "joints.",
       "lockbox view --model lockbox --source recording.oni --states out/run/states.csv"},
      {"devices", "Lists the depth cameras that OpenNI2 sees, or says why there is none",
       "Names each camera with its address for --source, and the modes that it offers.",
       "lockbox devices --uri virtual-depth:/tmp/camera"},
      {"cache", "Tells what the cache of distance fields holds, or clears it",
       "Distance fields of meshes are kept between runs, up to 1 GB. What is deleted is made "
       "again when it is needed.",
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
