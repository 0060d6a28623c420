// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lockbox::app {

/// Says on standard error how far a loop over frames (or other units) is: a bar that is redrawn on
/// a terminal, a line every few seconds elsewhere.
class Progress {
 public:
  /// total: number of units, if known. quiet: says nothing at all.
  Progress(std::string activity, std::optional<std::size_t> total, bool quiet,
           std::string unit = "frames");

  /// done: units so far; status: a word on the last one, may be empty.
  void update(std::size_t done, std::string_view status = {});

  /// The last line, with the average rate.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string line() const;
  std::string bar() const;

  std::string activity_;
  std::optional<std::size_t> total_;
  bool quiet_;
  std::string unit_;
  bool on_terminal_;
  Clock::time_point start_;
  Clock::time_point shown_;
  std::size_t done_ = 0;
  std::optional<std::size_t> shown_done_;
  std::string status_;
};

}  // namespace lockbox::app
