// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace lockbox::app {

/// The line on standard error that says how things stand: redrawn in its place on a terminal, one
/// after the other elsewhere, the first within a second.
class StatusLine {
 public:
  StatusLine();

  bool is_on_terminal() const { return on_terminal_; }

  /// No oftener than eyes follow, or than a log wants it.
  bool is_due() const;

  /// How long nothing was shown.
  std::chrono::duration<double> age() const { return Clock::now() - shown_; }

  void show(const std::string& text);

  /// Writes for the last time: what is written next begins below it.
  void leave(const std::string& text);

  /// Takes away what is shown on a terminal.
  void erase();

 private:
  using Clock = std::chrono::steady_clock;

  bool on_terminal_;
  Clock::time_point shown_;  ///< or begun
  bool is_first_ = true;     ///< the line to come
};

}  // namespace lockbox::app
