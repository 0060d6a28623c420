// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

namespace lockbox::app {
namespace {

using std::chrono::duration;

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr std::size_t kBarWidth = 24;

std::string minutes_and_seconds(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  std::ostringstream text;
  text << whole / 60 << ':' << std::setw(2) << std::setfill('0') << whole % 60;
  return text.str();
}

}  // namespace

Progress::Progress(std::string activity, std::optional<std::size_t> total, bool quiet,
                   std::string unit)
    : activity_(std::move(activity)),
      total_(total),
      quiet_(quiet),
      unit_(std::move(unit)),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      shown_(start_) {}

void Progress::update(std::size_t done, std::string_view status) {
  done_ = done;
  status_ = status;
  const auto now = Clock::now();
  const Clock::duration interval = on_terminal_ ? Clock::duration(kRedrawInterval) : kLineInterval;
  if (quiet_ || now - shown_ < interval) return;
  shown_ = now;
  shown_done_ = done;
  if (on_terminal_) {
    std::cerr << '\r' << line() << "\x1b[K" << std::flush;
  } else {
    std::cerr << line() << '\n';
  }
}

void Progress::finish() {
  if (quiet_ || (!on_terminal_ && shown_done_ == done_)) return;
  if (on_terminal_) std::cerr << '\r';
  std::cerr << line() << (on_terminal_ ? "\x1b[K\n" : "\n");
}

std::string Progress::line() const {
  const double elapsed = duration<double>(Clock::now() - start_).count();
  const double rate = elapsed > 0.0 ? static_cast<double>(done_) / elapsed : 0.0;
  std::ostringstream text;
  text << activity_ << ' ';
  if (on_terminal_ && total_) text << bar() << ' ';
  text << done_;
  if (total_) text << '/' << *total_;
  text << ' ' << unit_ << ", " << std::fixed << std::setprecision(1) << rate << ' ' << unit_
       << "/s";
  if (!status_.empty()) text << ", " << status_;
  if (total_ && done_ < *total_ && rate > 0.0) {
    text << ", " << minutes_and_seconds(static_cast<double>(*total_ - done_) / rate) << " left";
  }
  return text.str();
}

std::string Progress::bar() const {
  const std::size_t total = std::max<std::size_t>(*total_, 1);
  const std::size_t filled = std::min(kBarWidth, kBarWidth * done_ / total);
  return '[' + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + ']';
}

}  // namespace lockbox::app
