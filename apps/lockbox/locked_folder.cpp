// SPDX-License-Identifier: BSD-3-Clause
#include "locked_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "lockbox/core/error.hpp"
#include "output_paths.hpp"

namespace lockbox::app {
namespace {

/// The folder itself is locked: no lock file is left. Where the file system knows no locks, or the
/// folder cannot be opened, it goes on without one.
int locked(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
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
