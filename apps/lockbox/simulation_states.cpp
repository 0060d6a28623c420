// SPDX-License-Identifier: BSD-3-Clause
#include "simulation_states.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/capture/oni_player.hpp"
#include "lockbox/core/error.hpp"
#include "plausible_states.hpp"

namespace lockbox::app {
namespace {

constexpr int kUsualRate = 30;  // frames a second

void require_complete(const std::string& file, const std::vector<State>& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].known && states[i].configuration.q.allFinite()) continue;
    throw InputError(file, "state " + std::to_string(i + 1) +
                               " lacks the pose or a joint position; only complete states can be "
                               "simulated");
  }
}

}  // namespace

std::vector<State> read_trajectory(const std::string& file, const KinematicTree& tree, int most) {
  std::vector<State> states = read_states(file, tree).states;
  require_increasing_stamps(file, states);
  require_plausible(file, tree, states);
  states.resize(std::min(states.size(), static_cast<std::size_t>(most)));
  require_complete(file, states);
  return states;
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
