// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "status_line.hpp"
#include "ticker.hpp"

namespace lockbox::app {

/// Says on standard error how far a loop over frames (or other units) is: a bar that is redrawn on
/// a terminal, a line within a second and every few seconds then elsewhere. On a terminal it is
/// never still for more than a second while something was begun.
class Progress {
 public:
  /// total: number of units, if known. quiet: says nothing at all.
  Progress(std::string activity, std::optional<std::size_t> total, bool quiet,
           std::string unit = "frames");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What is done until the next update; shown with its seconds if it takes long.
  void begin(std::string_view phase);

  /// done: units so far; status: a word on the last one, may be empty.
  void update(std::size_t done, std::string_view status = {});

  /// The last line, with the average rate.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void tick();
  std::string line() const;
  std::string bar() const;

  std::string activity_;
  std::optional<std::size_t> total_;
  std::string unit_;
  Clock::time_point start_;
  std::mutex mutex_;  ///< of all below
  StatusLine shown_;
  bool has_begun_ = false;  ///< to say anything
  std::size_t done_ = 0;
  std::optional<std::size_t> shown_done_;
  std::string status_;
  std::string phase_;
  Clock::time_point phase_start_;
  std::optional<Ticker> ticker_;  ///< none if quiet, or finished
};

/// The same for a step that cannot be counted, while it lives.
class Activity {
 public:
  explicit Activity(std::string what, bool quiet = false);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

 private:
  std::string what_;
  std::chrono::steady_clock::time_point start_;
  StatusLine shown_;
  std::optional<Ticker> ticker_;
};

}  // namespace lockbox::app
