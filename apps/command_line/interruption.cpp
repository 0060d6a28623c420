// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

namespace lockbox::app {
namespace {

constexpr std::array kEndingSignals = {SIGHUP, SIGINT, SIGPIPE, SIGTERM};

// A signal handler gets no argument of ours: nothing but a variable of this kind can hear it.
std::atomic<int> noted{0};
std::atomic<const char*> last_words{nullptr};
static_assert(std::atomic<int>::is_always_lock_free, "else signal handlers may not touch it");

void note(int signal) {
  int none = 0;
  if (noted.compare_exchange_strong(none, signal) || signal == SIGPIPE) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Calls nothing but what a signal handler may call.
void say(const char* text) {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody listens
}

void end_at_once(int signal) {
  if (signal != SIGPIPE) {
    say(isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "");  // takes a status line away
    say("lockbox: ended by SIG");
    say(sigabbrev_np(signal));
    if (const char* const words = last_words) say(words);
    say("\n");
  }
  _exit(interruption::exit_status(signal));
}

}  // namespace

SignalHandlers::SignalHandlers(void (*handler)(int)) {
  static_assert(kEndingSignals.size() == kSignals);
  for (std::size_t i = 0; i < kSignals; ++i) {
    struct sigaction action = {};
    struct sigaction before = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(kEndingSignals[i], &action, &before);
    before_[i] = before.sa_handler;
    if (before.sa_handler == SIG_IGN && kEndingSignals[i] != SIGINT) {
      std::signal(kEndingSignals[i], SIG_IGN);
    }
  }
}

SignalHandlers::~SignalHandlers() {
  for (std::size_t i = 0; i < kSignals; ++i) std::signal(kEndingSignals[i], before_[i]);
}

LastWords::LastWords(const char* text) {
  last_words = text;
}

LastWords::~LastWords() {
  last_words = nullptr;
}

EndAtSignal::EndAtSignal() : handlers_(end_at_once) {}

Interruption::Interruption() : handlers_(note) {}

bool Interruption::requested() const {
  return interruption::requested();
}

bool interruption::requested() noexcept {
  return noted != 0;
}

int interruption::signal_number() noexcept {
  return noted;
}

Executor interruption::executor() {
  return Executor(0, Priority::normal, requested);
}

std::string interruption::signal_name() {
  return std::string("SIG").append(sigabbrev_np(noted));
}

}  // namespace lockbox::app
