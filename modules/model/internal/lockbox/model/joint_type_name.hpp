// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// Returns the name that a URDF file has for it.
std::string type_name(JointType type);

}  // namespace lockbox
