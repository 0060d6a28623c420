// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "lockbox/model/states_file.hpp"

namespace lockbox::app {

/// Why the states are hardly those of the model in metres and radians, with what mends it, or
/// empty: a base that is farther from the camera than any object that a depth camera sees, or a
/// joint that is far beyond its limits.
std::string implausibility(const KinematicTree& tree, const std::vector<State>& states);

/// Throws InputError, naming the file, if there is such a reason.
void require_plausible(const std::string& file, const KinematicTree& tree,
                       const std::vector<State>& states);

/// Throws InputError, naming the file, if there are none, or if one does not come after the one
/// before it.
void require_increasing_stamps(const std::string& file, const std::vector<State>& states);

}  // namespace lockbox::app
