// SPDX-License-Identifier: BSD-3-Clause
#include "progress.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <utility>

namespace lockbox::app {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

// How often it is looked whether a second (kLong) has passed in silence.
constexpr auto kTick = std::chrono::milliseconds(250);
constexpr auto kLong = std::chrono::milliseconds(750);
constexpr std::size_t kBarWidth = 24;

std::string minutes_and_seconds(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  std::ostringstream text;
  text << whole / 60 << ':' << std::setw(2) << std::setfill('0') << whole % 60;
  return text.str();
}

/// "searching: 12 s"
std::string with_seconds(const std::string& what, steady_clock::time_point start) {
  const auto seconds = duration<double>(steady_clock::now() - start).count();
  return what + ": " + std::to_string(static_cast<long>(seconds + 0.5)) + " s";
}

std::string singular(const std::string& unit) {
  return unit.ends_with('s') ? unit.substr(0, unit.size() - 1) : unit;
}

/// Whether a line that has not changed by itself is to be shown again.
bool is_silent(const StatusLine& line) {
  return line.is_due() && line.age() >= kLong;
}

}  // namespace

Progress::Progress(std::string activity, std::optional<std::size_t> total, bool quiet,
                   std::string unit)
    : activity_(std::move(activity)),
      total_(total),
      unit_(std::move(unit)),
      start_(Clock::now()),
      phase_start_(start_) {
  if (!quiet) ticker_.emplace(kTick, [this] { tick(); });
}

/// What an error says next does not mix with a line that was not finished.
Progress::~Progress() {
  if (!ticker_) return;
  ticker_.reset();
  shown_.erase();
}

void Progress::begin(std::string_view phase) {
  const std::lock_guard lock(mutex_);
  phase_ = phase;
  phase_start_ = Clock::now();
}

void Progress::update(std::size_t done, std::string_view status) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  status_ = status;
  phase_.clear();
  if (!ticker_ || !shown_.is_due()) return;
  has_begun_ = true;
  shown_done_ = done;
  shown_.show(line());
}

void Progress::finish() {
  if (!ticker_) return;
  ticker_.reset();
  phase_.clear();
  if (shown_.is_on_terminal() || shown_done_ != done_) shown_.leave(line());
}

void Progress::tick() {
  const std::lock_guard lock(mutex_);
  const bool says_more = !phase_.empty() || !has_begun_;
  if (!says_more || !is_silent(shown_)) return;
  has_begun_ = true;
  shown_.show(line());
}

std::string Progress::line() const {
  const double elapsed = duration<double>(Clock::now() - start_).count();
  const double rate = elapsed > 0.0 ? static_cast<double>(done_) / elapsed : 0.0;
  std::ostringstream text;
  text << activity_ << ' ';
  if (shown_.is_on_terminal() && total_) text << bar() << ' ';
  text << done_;
  if (total_) text << '/' << *total_;
  const std::string unit = total_.value_or(done_) == 1 ? singular(unit_) : unit_;
  text << ' ' << unit;
  if (!phase_.empty()) {
    text << ", " << with_seconds(phase_, phase_start_);
    return text.str();
  }
  if (done_ == 0) return text.str();
  text << ", " << std::fixed << std::setprecision(1) << rate << ' ' << unit_ << "/s";
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

Activity::Activity(std::string what, bool quiet)
    : what_(std::move(what)), start_(steady_clock::now()) {
  if (quiet) return;
  ticker_.emplace(kTick, [this] {
    if (is_silent(shown_)) shown_.show(with_seconds(what_, start_));
  });
}

Activity::~Activity() {
  if (!ticker_) return;
  ticker_.reset();
  shown_.erase();
}

}  // namespace lockbox::app
