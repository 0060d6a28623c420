// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lockbox {

/// Where distance fields are kept by default: $XDG_CACHE_HOME/lockbox, else ~/.cache/lockbox; empty
/// (no cache) where neither is known.
std::filesystem::path default_cache_folder();

}  // namespace lockbox
