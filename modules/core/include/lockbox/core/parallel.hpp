// SPDX-License-Identifier: BSD-3-Clause
// Parallel loops whose results do not depend on the number of threads: the work is cut into chunks
// of a fixed size, and whoever sums partial results does so in the order of the chunks.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>

#include "lockbox/core/function_ref.hpp"
#include "lockbox/core/stop_request.hpp"

namespace lockbox {

/// Whose loops get the workers when there are not enough for all.
enum class Priority { normal, low };

/// A parallel loop: calls body(i) once for each i in [0, count). The body is only borrowed.
struct Loop {
  static constexpr auto kNothing = [](std::size_t) {};  ///< the body of a loop that does nothing

  std::size_t count = 0;  ///< how often the body is called
  /// Called with the number of the call.
  FunctionRef<void(std::size_t)> body = kNothing;
};

/// A group of worker threads. Copyable; copies share the workers. Calls may not be nested.
class Executor {
 public:
  /// threads: how many work at the same time, the caller included; 0 means all cores. priority: of
  /// the workers; that of the caller is its own. stop_request: loops are stopped when it asks for
  /// that, too.
  explicit Executor(int threads = 0, Priority priority = Priority::normal,
                    StopRequest stop_request = nullptr);

  /// Returns how many threads work at the same time, the caller included.
  int threads() const;

  /// Says, within a body, which of the threads() workers runs it, for scratch memory of its own.
  static std::size_t worker();

  /// Calls body(i) once for each i in [0, count), in any order, and returns when all are done.
  /// An exception of a body reaches the caller; other bodies may be called before it does. Throws
  /// Stopped if it was stopped.
  void for_each(std::size_t count, FunctionRef<void(std::size_t)> body) const;

  /// Runs several loops that do not need each other as one: whoever is done with one need not wait
  /// for its last bodies. Those that take longest are best named first.
  void for_each(std::initializer_list<Loop> loops) const;

  /// Calls body(begin, end, chunk) for the consecutive ranges of chunk_size that cover [0, count).
  void for_each_chunk(
      std::size_t count, std::size_t chunk_size,
      FunctionRef<void(std::size_t begin, std::size_t end, std::size_t chunk)> body) const;

  /// Stops loops. Any thread may call it: the loop under way ends soon, without the bodies that
  /// have not begun, and so do all later ones until resume(). What loops were filling is left half
  /// done.
  void stop() const;
  /// Ends what stop() began: loops run again.
  void resume() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// Returns the number of chunks that for_each_chunk makes.
constexpr std::size_t chunk_count(std::size_t count, std::size_t chunk_size) {
  return (count + chunk_size - 1) / chunk_size;
}

}  // namespace lockbox
