// SPDX-License-Identifier: BSD-3-Clause
// The header of a .pcd file, checked: PCL's reader believes it.
#pragma once

#include <filesystem>

namespace lockbox {

/// Throws InputError unless the file is an organized cloud with float coordinates x, y, z whose
/// data is as long as its header says.
void check_pcd(const std::filesystem::path& file);

}  // namespace lockbox
