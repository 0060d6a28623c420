// SPDX-License-Identifier: BSD-3-Clause
// Programs and libraries that are loaded when they are asked for.
#pragma once

#include <filesystem>
#include <string>

namespace lockbox {

/// Path of a component: in the folder `lockbox` beside this library, or, where it is linked into a
/// program, in `../lib/lockbox` beside that. Throws DeviceError if it is not installed.
std::filesystem::path find_component(const std::string& name);

}  // namespace lockbox
