// SPDX-License-Identifier: BSD-3-Clause
// depth.txt: the images of a sequence and their times.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lockbox {

struct DepthIndexEntry {
  double stamp;  ///< seconds
  std::filesystem::path image;
  int line;  ///< counted from 1
};

/// Stamps in milli-, micro- or nanoseconds are brought to seconds. Lines that stand neither in the
/// order of their stamps nor in that of their names are sorted by stamps. Both are told to warn, if
/// it is set. A last line that was cut off is left out. Whether the images exist is not looked at.
/// Throws InputError with the line.
std::vector<DepthIndexEntry> read_depth_index(const std::filesystem::path& file,
                                              const std::function<void(const std::string&)>& warn);

}  // namespace lockbox
