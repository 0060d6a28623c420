// SPDX-License-Identifier: BSD-3-Clause
#include "simulation_states.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

constexpr int kUsualRate = 30;  // frames a second

}  // namespace

void require_increasing_stamps(const std::string& file, const std::vector<State>& states) {
  if (states.empty()) throw InputError(file, "holds no states");
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].stamp <= states[i - 1].stamp) {
      throw InputError(file, "timestamps must increase, that of state " + std::to_string(i + 1) +
                                 " (" + std::to_string(states[i].stamp) + ") does not");
    }
  }
}

int frames_per_second(const std::vector<State>& states) {
  if (states.size() < 2) return kUsualRate;
  const double duration = states.back().stamp - states.front().stamp;
  const double rate = static_cast<double>(states.size() - 1) / duration;
  return static_cast<int>(std::lround(std::clamp(rate, 1.0, 120.0)));
}

void take_recorded_stamps(const std::filesystem::path& recording, std::vector<State>& states) {
  OniPlayer player(recording);
  DepthFrame frame;
  for (State& state : states) {
    if (!player.next(frame)) throw DeviceError(recording.string() + ": frames are missing");
    state.stamp = frame.stamp;
  }
}

}  // namespace lockbox::app
