// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

namespace lockbox {

/// The name of a Unix socket in the file system, where a server shall listen.
class UnixPath {
 public:
  /// Takes a socket of that name away if nobody listens there any more. target: for messages.
  /// Throws InputError if somebody does, or if something else has that name.
  UnixPath(std::string path, const std::string& target);

  ~UnixPath() { remove(); }
  UnixPath(const UnixPath&) = delete;
  UnixPath& operator=(const UnixPath&) = delete;

  const std::string& path() const { return path_; }

  /// A socket of ours was bound there now.
  void note_bound();

  /// Takes away what was bound there, unless another has taken its place.
  void remove();

 private:
  std::string path_;
  dev_t device_ = 0;
  ino_t inode_ = 0;  ///< 0: not bound
};

}  // namespace lockbox
