// SPDX-License-Identifier: BSD-3-Clause
// VTK's readers trust what they read: an index without a vertex is memory read out of bounds, half
// a file is half a mesh. So files are checked first, and what VTK made of them is counted after.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace lockbox {

/// Each throws InputError naming the file, or returns how many polygons a reader has to find.
std::size_t check_obj(const std::filesystem::path& file, const std::string& content);
std::size_t check_stl(const std::filesystem::path& file, const std::string& content);
std::size_t check_ply(const std::filesystem::path& file, const std::string& content);

}  // namespace lockbox
