// SPDX-License-Identifier: BSD-3-Clause
// Trajectories in the format of the TUM RGB-D data sets: lines `timestamp tx ty tz qx qy qz qw`,
// and comments after `#`. lockbox writes base.tum so; motion capture systems deliver them.
#pragma once

#include <filesystem>

#include "lockbox/model/states_file.hpp"

namespace lockbox {

/// Whether the first line that is no comment holds eight numbers between blanks.
bool is_tum_trajectory(const std::filesystem::path& file);

/// The poses of the base, as states without joints; seconds, metres. Throws InputError with the
/// line.
StatesFile read_tum_trajectory(const std::filesystem::path& file);

}  // namespace lockbox
