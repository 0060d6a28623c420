// SPDX-License-Identifier: BSD-3-Clause
// Simulated frames together with the states that they show.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lockbox/core/depth_frame.hpp"
#include "lockbox/core/parallel.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/scene.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

struct Recording {
  std::vector<State> truth;
  std::vector<DepthFrame> frames;  ///< one a state, with its stamp
};

/// The surroundings of a simulated run, and the camera that looks at it.
struct RecordingSettings {
  Scene scene;
  PinholeCamera camera;
  SensorModel sensor;
  std::uint64_t seed = 1;  ///< of the sensor's noise
};

/// on_frame(number of frames done) is called after each, if it is set.
Recording simulate_recording(const KinematicTree& tree, const std::vector<State>& truth,
                             const RecordingSettings& settings, const Executor& executor,
                             const std::function<void(std::size_t)>& on_frame = {});

/// Returns states of one configuration for so many frames, 30 a second.
std::vector<State> still_states(const Configuration& configuration, int frames);

}  // namespace lockbox
