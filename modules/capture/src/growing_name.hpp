// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lockbox {

/// What a recording is called until it is complete.
inline std::filesystem::path growing_name(const std::filesystem::path& recording) {
  return recording.string() + ".part";
}

}  // namespace lockbox
