// SPDX-License-Identifier: BSD-3-Clause
#include "locked_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "command_line/output_paths.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/file_lock.hpp"

namespace lockbox::app {
namespace {

/// The folder itself is locked: no lock file is left. Where it cannot be opened, it goes on without
/// a lock.
int locked(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0 && !lock_alone(descriptor)) {
    ::close(descriptor);
    throw InputError(folder.string(),
                     "another run is writing into this folder; wait for its end, or choose another "
                     "folder");
  }
  return descriptor;
}

}  // namespace

LockedFolder::LockedFolder(const std::filesystem::path& folder) {
  make_folder(folder);
  descriptor_ = locked(folder);
}

LockedFolder::~LockedFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace lockbox::app
