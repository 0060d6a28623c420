// SPDX-License-Identifier: BSD-3-Clause
#include "states_in_metres.hpp"

#include "lockbox/core/error.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/core/units.hpp"

namespace lockbox::app {

void require_metres(const std::string& file, const std::vector<State>& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!states[i].known) continue;
    const double distance = states[i].configuration.T_camera_base.translation().norm();
    if (distance <= kFarthestBase) continue;
    const bool may_be_millimetres = distance / kMillimetres <= kFarthestBase;
    throw InputError(
        file,
        "state " + std::to_string(i + 1) + " puts the base " + readable_length(distance) +
            " away from the camera, where no depth camera sees it; positions are in metres" +
            (may_be_millimetres ? ", these seem to be in millimetres: divide them by 1000" : ""));
  }
}

}  // namespace lockbox::app
