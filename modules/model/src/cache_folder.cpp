// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/model/cache_folder.hpp"

#include <cstdlib>

namespace lockbox {

std::filesystem::path default_cache_folder() {
  // The XDG specification ignores relative paths.
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && std::filesystem::path(cache).is_absolute()) {
    return std::filesystem::path(cache) / "lockbox";
  }
  const char* home = std::getenv("HOME");
  if (home != nullptr && std::filesystem::path(home).is_absolute()) {
    return std::filesystem::path(home) / ".cache" / "lockbox";
  }
  return {};
}

}  // namespace lockbox
