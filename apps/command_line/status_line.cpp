// SPDX-License-Identifier: BSD-3-Clause
#include "status_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

namespace lockbox::app {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr auto kFirstLine = std::chrono::milliseconds(750);  // then it is known what goes on
constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr auto kErase = "\r\x1b[K";

/// What wraps cannot be redrawn.
std::string cut_to_terminal(const std::string& text) {
  winsize size = {};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return text;
  return text.substr(0, size.ws_col - 1U);
}

}  // namespace

StatusLine::StatusLine() : on_terminal_(isatty(STDERR_FILENO) != 0), shown_(Clock::now()) {}

bool StatusLine::is_due() const {
  if (on_terminal_) return age() >= kRedrawInterval;
  return age() >= (is_first_ ? Clock::duration(kFirstLine) : kLineInterval);
}

void StatusLine::show(const std::string& text) {
  shown_ = Clock::now();
  is_first_ = false;
  if (on_terminal_) {
    // What others write then takes its place.
    std::cerr << kErase << cut_to_terminal(text) + '\r' << std::flush;
  } else {
    std::cerr << text + '\n';
  }
}

void StatusLine::leave(const std::string& text) {
  erase();
  std::cerr << text + '\n';
}

void StatusLine::erase() {
  if (on_terminal_) std::cerr << kErase << std::flush;
}

}  // namespace lockbox::app
