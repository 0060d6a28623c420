// SPDX-License-Identifier: BSD-3-Clause
// How long a cache line takes from one thread to another: five times as long if their cores share
// no cache, and then all that one wrote and the other reads keeps both waiting.
#include <benchmark/benchmark.h>

#include <atomic>
#include <thread>

namespace lockbox {
namespace {

enum class Turn { ours, theirs, over };

/// There and back.
void hand_over(benchmark::State& state) {
  alignas(64) std::atomic<Turn> turn{Turn::ours};
  std::thread other([&turn] {
    for (Turn now = turn; now != Turn::over; now = turn) {
      if (now == Turn::theirs) turn = Turn::ours;
    }
  });
  for (auto _ : state) {
    turn = Turn::theirs;
    while (turn != Turn::ours) {
    }
  }
  turn = Turn::over;
  other.join();
}

BENCHMARK(hand_over)->UseRealTime();

}  // namespace
}  // namespace lockbox
