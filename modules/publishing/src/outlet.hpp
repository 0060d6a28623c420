// SPDX-License-Identifier: BSD-3-Clause
// What every kind of target does, and the queue of lines that wait for a reader.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "lockbox/publishing/publisher.hpp"

namespace lockbox {

/// With its end of line; all readers share it.
using Line = std::shared_ptr<const std::string>;

/// So many lines wait for one reader, four seconds of a camera of 30 frames a second: a pause that
/// a garbage collector or a busy machine makes. Doubled, a reader that is too slow for good lives
/// eight seconds in the past.
inline constexpr std::size_t kWaitingLines = 128;

/// At the end of a run readers get so long for what waits for them: on one machine they need
/// milliseconds. Doubled, a run whose readers have stopped reading ends as much later.
inline constexpr auto kFarewell = std::chrono::milliseconds(500);

/// Holds what a reader could not take yet; of too many lines the newest.
class LineQueue {
 public:
  /// Returns how many lines had to go.
  std::size_t push(const Line& line) {
    lines_.push_back(line);
    if (lines_.size() <= kWaitingLines) return 0;
    lines_.pop_front();
    return 1;
  }

  Line pop() {
    const Line line = lines_.front();
    lines_.pop_front();
    return line;
  }

  bool empty() const { return lines_.empty(); }
  std::size_t size() const { return lines_.size(); }

 private:
  std::deque<Line> lines_;
};

class Outlet {
 public:
  virtual ~Outlet() = default;

  /// Does not wait.
  virtual void send(const Line& line) = 0;

  /// Waits for readers, at most kFarewell; once.
  virtual void close() = 0;

  virtual std::string address() const = 0;
  virtual Publication publication() const = 0;

  /// See Publisher::output_error().
  virtual int error() const { return 0; }
};

// One source each. They throw InputError if the target cannot be had.
std::unique_ptr<Outlet> make_standard_output(const PublishTarget& target);
std::unique_ptr<Outlet> make_tcp_server(const PublishTarget& target);
std::unique_ptr<Outlet> make_unix_server(const PublishTarget& target);
std::unique_ptr<Outlet> make_udp_sender(const PublishTarget& target);

}  // namespace lockbox
