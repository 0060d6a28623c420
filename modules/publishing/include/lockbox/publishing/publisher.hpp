// SPDX-License-Identifier: BSD-3-Clause
// Hands lines of text to whoever wants to read them, and never waits for anybody.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lockbox/publishing/publish_target.hpp"

namespace lockbox {

/// What became of the lines of one target.
struct Publication {
  std::string target;       ///< as it was given
  std::size_t readers = 0;  ///< that have ever connected; of targets without connections 1
  std::size_t dropped = 0;  ///< lines that a reader that was connected did not get in time
  std::string address;      ///< where it can be reached, see Publisher::addresses()
};

class Outlet;

/// All calls come from one thread. Sockets are served by threads of its own, in which SIGPIPE is
/// blocked.
class Publisher {
 public:
  /// Begins to listen. Throws InputError where a target cannot be had: a port in use, a Unix socket
  /// at which somebody listens, a path that is no socket, a host that is not known, a standard
  /// output that is closed, a target that is there twice. A socket that nobody listens at any more
  /// is replaced.
  explicit Publisher(const std::vector<PublishTarget>& targets);
  ~Publisher();
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;

  /// Hands the line to all who are connected, without waiting: who is too slow loses the oldest of
  /// the lines that wait for them. line: without an end of line.
  void publish(const std::string& line);

  /// Gives readers half a second for what still waits for them, and ends. Sockets are removed.
  void close();

  /// Returns why lines are no longer written to standard output: EPIPE (its reader has gone away)
  /// or another errno; 0 while they are. Known some time after publish(), for good after close().
  int output_error() const;

  /// Returns where it can be reached, such as "tcp 127.0.0.1:5555", one for each target.
  std::vector<std::string> addresses() const;

  /// Returns one for each target; they are complete after close().
  std::vector<Publication> publications() const;

 private:
  std::vector<std::unique_ptr<Outlet>> outlets_;
};

}  // namespace lockbox
