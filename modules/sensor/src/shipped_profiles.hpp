// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace lockbox {

/// The file of the shipped profile of that name; none if there is no such.
std::optional<std::filesystem::path> shipped_profile(const std::string& name);

}  // namespace lockbox
