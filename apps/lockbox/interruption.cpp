// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <csignal>

namespace lockbox::app {
namespace {

// A signal handler gets no argument of ours: nothing but a variable of this kind can hear it.
volatile std::sig_atomic_t interrupted = 0;

void note_interruption(int) {
  interrupted = 1;
}

}  // namespace

Interruption::Interruption() {
  interrupted = 0;
  struct sigaction action = {};
  action.sa_handler = note_interruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::requested() const {
  return interrupted != 0;
}

}  // namespace lockbox::app
