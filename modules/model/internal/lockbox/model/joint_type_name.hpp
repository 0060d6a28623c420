// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// As a URDF file has it.
std::string type_name(JointType type);

}  // namespace lockbox
