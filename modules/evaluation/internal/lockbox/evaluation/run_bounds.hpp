// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "lockbox/core/parallel.hpp"
#include "lockbox/evaluation/bounds_file.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/simulation/placed_scene.hpp"
#include "lockbox/simulation/sensor_model.hpp"

namespace lockbox {

/// The bound of every state of a run, each for a single frame without memory (see bound.hpp).
/// States that are not known get infinite bounds. on_frame(number of frames done) is called after
/// each, if it is set.
std::vector<FrameBound> compute_run_bounds(const KinematicTree& tree, const std::vector<State>& run,
                                           const PinholeCamera& camera, const SensorModel& sensor,
                                           const PlacedScene& scene, const Executor& executor,
                                           const std::function<void(std::size_t)>& on_frame = {});

}  // namespace lockbox
