// SPDX-License-Identifier: BSD-3-Clause
// The same model, written differently.
#pragma once

#include <cstdint>
#include <filesystem>

namespace lockbox::app {

/// Copies a URDF, its links and joints in a random order and, if asked to, its links under random
/// names. Meshes are referred to where they are; the parameters beside it are copied as they are.
/// Throws InputError if the file cannot be read or the copy not be written.
void write_urdf_variant(const std::filesystem::path& urdf, const std::filesystem::path& copy,
                        bool rename_links, std::uint64_t seed, std::uint64_t number);

}  // namespace lockbox::app
