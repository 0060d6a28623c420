// SPDX-License-Identifier: BSD-3-Clause
// The states that a simulation renders, and the stamps that they get.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "lockbox/model/states_file.hpp"

namespace lockbox::app {

inline constexpr int kAllStates = std::numeric_limits<int>::max();

/// The first so many states of the file, if there are as many. Throws InputError, naming the file,
/// unless they increase, are plausible, and tell the pose and every joint.
std::vector<State> read_trajectory(const std::string& file, const KinematicTree& tree, int most);

/// The nominal rate of a recording of these states.
int frames_per_second(const std::vector<State>& states);

/// Gives the states the stamps of the frames as a player of the recording sees them. Throws
/// DeviceError if frames are missing.
void take_recorded_stamps(const std::filesystem::path& recording, std::vector<State>& states);

}  // namespace lockbox::app
