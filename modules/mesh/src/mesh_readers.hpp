// SPDX-License-Identifier: BSD-3-Clause
// Mesh files are read by what checks them. A library behind a check dies where the two read a
// format differently, and formats that a dozen programs write are read differently by all.
#pragma once

#include <filesystem>
#include <string_view>

#include "polygon_soup.hpp"

namespace lockbox {

/// Each takes the content of a whole file and throws InputError, naming the file and where there
/// are lines the line. What tracking does not use (normals, texture, colours) is not looked at.
PolygonSoup read_obj(const std::filesystem::path& file, std::string_view content);
PolygonSoup read_stl(const std::filesystem::path& file, std::string_view content);
PolygonSoup read_ply(const std::filesystem::path& file, std::string_view content);

}  // namespace lockbox
