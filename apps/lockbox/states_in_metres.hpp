// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "lockbox/model/states_file.hpp"

namespace lockbox::app {

/// Throws InputError, naming the file, if a base is farther from the camera than any object that a
/// depth camera sees: its position is in millimetres, most probably.
void require_metres(const std::string& file, const std::vector<State>& states);

}  // namespace lockbox::app
