// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "hand_over.hpp"

namespace lockbox {
namespace {

std::size_t body_count(std::initializer_list<Loop> loops) {
  return std::accumulate(loops.begin(), loops.end(), std::size_t{0},
                         [](std::size_t count, const Loop& loop) { return count + loop.count; });
}

/// Loops cut into one share for each thread: a range of the first, one of the second, and so on.
/// Whoever is done with its own takes from those of others, in their order: what is named first
/// has begun by then, and the wait for the last bodies is short. As threads have the same share of
/// each loop over rows of an image, they find in their caches what they wrote themselves.
class Shares {
 public:
  Shares(std::initializer_list<Loop> loops, std::size_t threads)
      : loops_(loops), size_(std::min(threads, kMost)) {
    for (std::size_t share = 0; share < size_; ++share) {
      for (const Loop& loop : loops) shares_[share].count += end(loop, share) - begin(loop, share);
    }
  }

  std::size_t size() const { return size_; }

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
  static constexpr std::size_t kMost = 16;

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

}  // namespace

struct Executor::Impl {
  Priority priority;
  tbb::task_arena arena;
  std::atomic<bool> is_stopped{false};
};

Executor::Executor(int threads, Priority priority) : impl_(std::make_shared<Impl>(priority)) {
  constexpr unsigned kCallers = 1;
  impl_->arena.initialize(threads > 0 ? threads : tbb::this_task_arena::max_concurrency(), kCallers,
                          priority == Priority::low ? tbb::task_arena::priority::low
                                                    : tbb::task_arena::priority::normal);
}

int Executor::threads() const {
  return impl_->arena.max_concurrency();
}

std::size_t Executor::worker() {
  const int index = tbb::this_task_arena::current_thread_index();
  return index == tbb::task_arena::not_initialized ? 0 : static_cast<std::size_t>(index);
}

void Executor::for_each(std::size_t count, FunctionRef<void(std::size_t)> body) const {
  for_each({{count, body}});
}

void Executor::for_each(std::initializer_list<Loop> loops) const {
  const HandOver to_bodies;
  const HandOver to_caller;
  const auto observed_body = [&](const Loop& loop, std::size_t i) {
    if (impl_->is_stopped) return;
    to_bodies.receive();
    loop.body(i);
    to_caller.give();
  };
  to_bodies.give();
  impl_->arena.execute([&] {
    if (threads() == 1 || body_count(loops) <= 1) {  // no tasks for those who will not come
      for (const Loop& loop : loops) {
        for (std::size_t i = 0; i < loop.count; ++i) observed_body(loop, i);
      }
    } else {
      Shares shares(loops, static_cast<std::size_t>(threads()));
      // Those of low priority are called away between tasks, where others want them.
      const bool has_many_tasks = impl_->priority == Priority::low;
      const std::size_t tasks = has_many_tasks ? body_count(loops) : shares.size();
      const auto task = [&](std::size_t) {
        while (shares.do_next(worker(), observed_body) && !has_many_tasks) {
        }
      };
      tbb::parallel_for(std::size_t{0}, tasks, task, tbb::simple_partitioner());
    }
  });
  to_caller.receive();
  if (impl_->is_stopped) throw Stopped();
}

void Executor::stop() const {
  impl_->is_stopped = true;
}

void Executor::resume() const {
  impl_->is_stopped = false;
}

void Executor::for_each_chunk(std::size_t count, std::size_t chunk_size,
                              FunctionRef<void(std::size_t, std::size_t, std::size_t)> body) const {
  for_each(chunk_count(count, chunk_size), [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_size;
    body(begin, std::min(begin + chunk_size, count), chunk);
  });
}

}  // namespace lockbox
