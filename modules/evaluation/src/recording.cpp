// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/recording.hpp"

#include "lockbox/simulation/simulator.hpp"

namespace lockbox {

Recording simulate_recording(const KinematicTree& tree, const std::vector<State>& truth,
                             const RecordingSettings& settings, const Executor& executor,
                             const std::function<void(std::size_t)>& on_frame) {
  Recording recording{truth, {}};
  Simulator simulator(tree, settings.camera, PlacedScene(settings.scene, truth), settings.sensor,
                      settings.seed, executor);
  recording.frames.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    simulator.simulate(truth[i], i, recording.frames.emplace_back());
    if (on_frame) on_frame(i + 1);
  }
  return recording;
}

std::vector<State> still_states(const Configuration& configuration, int frames) {
  constexpr double kRate = 30.0;
  std::vector<State> states;
  for (int frame = 0; frame < frames; ++frame) {
    State& state = states.emplace_back();
    state.stamp = frame / kRate;
    state.configuration = configuration;
  }
  return states;
}

}  // namespace lockbox
