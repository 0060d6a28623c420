// SPDX-License-Identifier: BSD-3-Clause
// What calls from Python need that take long: other threads go on meanwhile, Ctrl-C ends them, and
// warnings come out as Python's own.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "lockbox/core/parallel.hpp"

namespace lockbox::python {

namespace py = pybind11;

/// Runs calls one after the other, without Python's lock. Their work asks requested() whether it is
/// to stop.
class Interruptible {
 public:
  /// Returns whether it is asked to stop, in any thread. Python's signal handlers run in the thread
  /// of the call.
  bool requested();

  /// The result of the call, or the exception that a signal handler has raised (KeyboardInterrupt).
  template <typename Call>
  auto run(Call call) {
    py::gil_scoped_release others_go_on;
    const std::lock_guard one_at_a_time(mutex_);
    begin();
    try {
      return end(call());
    } catch (const Stopped&) {
      throw_if_interrupted();
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void throw_if_interrupted();

  template <typename Result>
  Result end(Result result) {
    throw_if_interrupted();
    return result;
  }

  std::mutex mutex_;
  std::atomic<std::thread::id> caller_;
  std::atomic<bool> is_interrupted_{false};
  Clock::time_point asked_;  ///< the caller's
};

/// Warnings that come while Python's lock is not held.
class Warnings {
 public:
  void add(const std::string& text);

  /// Gives them to Python's `warnings`. Throws where it makes errors of them.
  void issue();

 private:
  std::mutex mutex_;
  std::vector<std::string> texts_;
};

}  // namespace lockbox::python
