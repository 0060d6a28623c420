// SPDX-License-Identifier: BSD-3-Clause
// What ThreadSanitizer has to be told about TBB, which is not compiled with it.
#pragma once

#ifdef LOCKBOX_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace lockbox {

/// Everything before give() happens before what follows receive(), in whatever threads they are
/// called. This says so to ThreadSanitizer and does nothing else: the caller sees to it.
class HandOver {
 public:
#ifdef LOCKBOX_THREAD_SANITIZER
  void give() const {
    __tsan_release(address());
  }
  void receive() const {
    __tsan_acquire(address());
  }

 private:
  void* address() const {
    return const_cast<HandOver*>(this);
  }
#else
  void give() const {}
  void receive() const {}
#endif
};

}  // namespace lockbox
