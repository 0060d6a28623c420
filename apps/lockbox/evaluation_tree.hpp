// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox::app {

/// The tree whose joints the columns of the states file are: that of the model which the run.yaml
/// beside the file names, if there is one; else joints of unknown type, one a column, which are
/// compared modulo 2 pi. Throws InputError.
KinematicTree tree_of_states(const std::filesystem::path& states_file);

}  // namespace lockbox::app
