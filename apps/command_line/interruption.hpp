// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a run: noted where loops, searches and waiting sources can end early and leave
// complete files, heeded at once where there is nothing to leave.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "lockbox/core/parallel.hpp"

namespace lockbox::app {

/// What the ending signals, SIGHUP, SIGINT, SIGPIPE and SIGTERM, do while it lives. What whoever
/// started the program has told it to ignore (nohup) stays ignored; but for SIGINT, which shells
/// ignore for everything in the background.
class SignalHandlers {
 public:
  explicit SignalHandlers(void (*handler)(int));
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

 private:
  static constexpr std::size_t kSignals = 4;
  std::array<void (*)(int), kSignals> before_{};
};

/// While it lives, and no Interruption does, such a signal ends the process at once, saying so,
/// with the status of the signal: for work that leaves nothing half done behind, like loading.
class EndAtSignal {
 public:
  EndAtSignal();

 private:
  SignalHandlers handlers_;
};

/// While it lives, an end at once says this, too: what is lost, and how to go on.
class LastWords {
 public:
  /// text: a literal.
  explicit LastWords(const char* text);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;
};

/// While it lives, the first SIGHUP, SIGINT, SIGPIPE or SIGTERM is only noted. The next one ends
/// the process at once, as usual; but for SIGPIPE, which comes with every line that nobody reads.
/// At most one lives at a time.
class Interruption {
 public:
  Interruption();

  bool requested() const;

 private:
  SignalHandlers handlers_;
};

namespace interruption {

/// Whether such a signal was noted, by any Interruption. For any thread, at any time.
bool requested() noexcept;

/// The exit status of a process that such a signal has ended, as shells say it: 128 and its number.
constexpr int exit_status(int signal) {
  return 128 + signal;
}

/// Its number, 0 if there was none.
int signal_number() noexcept;

/// Workers whose loops are stopped then.
Executor executor();

/// Its name, such as "SIGINT".
std::string signal_name();

}  // namespace interruption
}  // namespace lockbox::app
