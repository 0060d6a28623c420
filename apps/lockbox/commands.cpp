// SPDX-License-Identifier: BSD-3-Clause
#include "commands.hpp"

#include <map>

namespace lockbox::app {

std::unique_ptr<Command> make_command(const std::string& name) {
  static const std::map<std::string, std::unique_ptr<Command> (*)()> makers = {
      {"track", make_track_command},     {"simulate", make_simulate_command},
      {"record", make_record_command},   {"evaluate", make_evaluate_command},
      {"inspect", make_inspect_command}, {"view", make_view_command},
      {"devices", make_devices_command}, {"cache", make_cache_command},
  };
  return makers.at(name)();
}

}  // namespace lockbox::app
