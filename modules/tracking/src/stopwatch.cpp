// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/stopwatch.hpp"

#include <ctime>

namespace lockbox {
namespace {

double read_ms(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

Elapsed now() {
  return {read_ms(CLOCK_MONOTONIC), read_ms(CLOCK_THREAD_CPUTIME_ID)};
}

}  // namespace

Stopwatch::Stopwatch() : began_(now()) {}

Elapsed Stopwatch::elapsed() const {
  const Elapsed ended = now();
  return {ended.wall_ms - began_.wall_ms, ended.cpu_ms - began_.cpu_ms};
}

}  // namespace lockbox
