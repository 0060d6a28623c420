// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/file_lock.hpp"

#include <sys/file.h>

#include <cerrno>

namespace lockbox {

bool lock_alone(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace lockbox
