// SPDX-License-Identifier: BSD-3-Clause
// Reads organized clouds from .pcd files. PCL's own reader reads the header again, in its own way,
// and takes memory for what it finds there; this one reads what pcd_header.hpp has checked.
#pragma once

#include <filesystem>

#include "pcd_component.hpp"

namespace lockbox {

/// Text, binary, or compressed (then the component must be installed). The viewpoint is not used:
/// points are taken to be in the camera's frame. Throws InputError.
void load_pcd(const std::filesystem::path& file, OrganizedCloud& cloud);

}  // namespace lockbox
