// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox::app {

/// By the time of the frame in seconds, as it stands in states.csv.
using AlternativesByStamp = std::map<double, std::vector<ShownAlternative>>;

/// What alternatives.csv tells beside the states.csv of a run; nothing if either is called
/// otherwise or is not there. Throws InputError with file and line if it holds something else.
AlternativesByStamp read_alternatives_beside(const std::filesystem::path& states,
                                             const KinematicTree& tree);

}  // namespace lockbox::app
