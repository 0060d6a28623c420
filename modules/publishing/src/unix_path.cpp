// SPDX-License-Identifier: BSD-3-Clause
#include "unix_path.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

/// 0, or why nobody could be reached there.
int connection_error(const std::string& path) {
  const int probe = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (probe < 0) return errno;
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const int result = ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  const int error = result == 0 ? 0 : errno;
  ::close(probe);
  return error;
}

}  // namespace

UnixPath::UnixPath(std::string path, const std::string& target) : path_(std::move(path)) {
  struct stat status = {};
  if (::lstat(path_.c_str(), &status) != 0) return;
  if (!S_ISSOCK(status.st_mode)) {
    throw InputError(target, "there is a file of that name that is no socket; give another path");
  }
  const int error = connection_error(path_);
  if (error == ECONNREFUSED) {
    ::unlink(path_.c_str());
  } else if (error == 0 || error == EAGAIN) {  // EAGAIN: so many connect that it cannot keep up
    throw InputError(target, "another program listens there; end it, or give another path");
  } else {
    throw InputError(target, std::string("there is a socket that cannot be reached (") +
                                 std::strerror(error) + "); remove it, or give another path");
  }
}

void UnixPath::remove() {
  struct stat status = {};
  if (inode_ == 0 || ::lstat(path_.c_str(), &status) != 0) return;
  if (status.st_dev == device_ && status.st_ino == inode_) ::unlink(path_.c_str());
  inode_ = 0;
}

void UnixPath::note_bound() {
  struct stat status = {};
  if (::lstat(path_.c_str(), &status) != 0) return;
  device_ = status.st_dev;
  inode_ = status.st_ino;
}

}  // namespace lockbox
