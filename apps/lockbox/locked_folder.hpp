// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace lockbox::app {

/// A folder that one run writes into, and no other while it lives; a crash unlocks it, too.
class LockedFolder {
 public:
  /// Makes the folder. Throws InputError if it cannot be made, or if another run writes into it.
  explicit LockedFolder(const std::filesystem::path& folder);
  ~LockedFolder();
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

 private:
  int descriptor_;
};

}  // namespace lockbox::app
