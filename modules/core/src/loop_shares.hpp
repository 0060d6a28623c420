// SPDX-License-Identifier: BSD-3-Clause
// Who does what of several loops that run as one.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <initializer_list>

#include "lockbox/core/parallel.hpp"

namespace lockbox {

/// Loops cut into one share for each thread: a range of the first, one of the second, and so on.
/// Whoever is done with its own takes from those of others, in their order: what is named first
/// has begun by then, and the wait for the last bodies is short. As threads have the same share of
/// each loop over rows of an image, they find in their caches what they wrote themselves. Of many
/// threads, several have one share.
class LoopShares {
 public:
  LoopShares(std::initializer_list<Loop> loops, std::size_t threads)
      : loops_(loops), size_(std::min(threads, kMost)) {
    for (std::size_t share = 0; share < size_; ++share) {
      for (const Loop& loop : loops) shares_[share].count += end(loop, share) - begin(loop, share);
    }
  }

  /// Calls body(loop, i) for the worker's next one; false if none is left.
  template <class Body>
  bool do_next(std::size_t worker, const Body& body) {
    for (std::size_t k = 0; k < size_; ++k) {
      const std::size_t number = (worker + k) % size_;
      Share& share = shares_[number];
      if (share.next.load(std::memory_order_relaxed) >= share.count) continue;
      const std::size_t i = share.next++;
      if (i < share.count) {
        call(number, i, body);
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t kMost = 16;  // shares

  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};
    std::size_t count = 0;
  };

  std::size_t begin(const Loop& loop, std::size_t share) const {
    return loop.count * share / size_;
  }
  std::size_t end(const Loop& loop, std::size_t share) const { return begin(loop, share + 1); }

  /// Every other share is done from its end on: what others take from it lies where two meet.
  template <class Body>
  void call(std::size_t share, std::size_t i, const Body& body) const {
    for (const Loop& loop : loops_) {
      const std::size_t first = begin(loop, share);
      const std::size_t last = end(loop, share);
      if (i < last - first) return body(loop, share % 2 == 0 ? first + i : last - 1 - i);
      i -= last - first;
    }
  }

  std::initializer_list<Loop> loops_;
  std::size_t size_;
  std::array<Share, kMost> shares_;
};

}  // namespace lockbox
