// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "hand_over.hpp"
#include "loop_shares.hpp"

namespace lockbox {
namespace {

std::size_t body_count(std::initializer_list<Loop> loops) {
  return std::accumulate(loops.begin(), loops.end(), std::size_t{0},
                         [](std::size_t count, const Loop& loop) { return count + loop.count; });
}

/// What more threads than cores compute is the same, only later. A few a core are let through: a
/// number that was chosen for a larger machine still works, and races between more threads than a
/// small machine has cores show in tests. Each takes a stack (8 MB of addresses) and scratch
/// memory, of a search some megabytes: thousands of them end a machine. Twice as many a core take
/// twice as much for nothing.
int most_threads() {
  constexpr int kPerCore = 4;
  constexpr int kOnSmallMachines = 16;
  static const auto cores = static_cast<int>(std::thread::hardware_concurrency());  // reads a file
  return std::max(kPerCore * cores, kOnSmallMachines);
}

/// Whoever asks for more threads than cores gets them: TBB would hold all groups together to what
/// the first one wanted, and say so on standard error. Where nobody asks there are no more than
/// cores, so that groups of low priority leave them to others.
void allow_threads(int threads) {
  static std::mutex mutex;
  static int allowed = static_cast<int>(std::thread::hardware_concurrency());
  static std::unique_ptr<tbb::global_control> control;  // of several the least would count
  const std::lock_guard lock(mutex);
  if (threads <= allowed) return;
  allowed = threads;
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads));
}

}  // namespace

struct Executor::Impl {
  Priority priority = Priority::normal;
  tbb::task_arena arena;
  std::atomic<bool> is_stopped{false};
  StopRequest stop_request;

  bool is_to_stop() const { return is_stopped || (stop_request && stop_request()); }
};

Executor::Executor(int threads, Priority priority, StopRequest stop_request)
    : impl_(std::make_shared<Impl>()) {
  impl_->priority = priority;
  impl_->stop_request = std::move(stop_request);
  constexpr unsigned kCallers = 1;
  const int taken =
      threads > 0 ? std::min(threads, most_threads()) : tbb::this_task_arena::max_concurrency();
  allow_threads(taken);
  impl_->arena.initialize(taken, kCallers,
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
    to_bodies.receive();
    if (!impl_->is_to_stop()) loop.body(i);
    to_caller.give();
  };
  to_bodies.give();
  impl_->arena.execute([&] {
    const std::size_t bodies = body_count(loops);
    if (threads() == 1 || bodies <= 1) {  // no tasks for those who will not come
      for (const Loop& loop : loops) {
        for (std::size_t i = 0; i < loop.count; ++i) observed_body(loop, i);
      }
    } else {
      const auto workers = static_cast<std::size_t>(threads());
      LoopShares shares(loops, workers);
      // Those of low priority are called away between tasks, where others want them.
      const bool has_many_tasks = impl_->priority == Priority::low;
      const std::size_t tasks = has_many_tasks ? bodies : std::min(bodies, workers);
      const auto task = [&](std::size_t) {
        while (shares.do_next(worker(), observed_body) && !has_many_tasks) {
        }
      };
      tbb::parallel_for(std::size_t{0}, tasks, task, tbb::simple_partitioner());
    }
  });
  to_caller.receive();
  if (impl_->is_to_stop()) throw Stopped();
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
