// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/stopwatch.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace lockbox {
namespace {

TEST(Stopwatch, SleepTakesTimeButNotOfTheProcessor) {
  const Stopwatch watch;
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const Elapsed elapsed = watch.elapsed();
  EXPECT_GE(elapsed.wall_ms, 50.0);
  EXPECT_LT(elapsed.cpu_ms, 0.5 * elapsed.wall_ms);
}

TEST(Stopwatch, WorkTakesTimeOfTheProcessor) {
  const Stopwatch watch;
  while (watch.elapsed().cpu_ms < 5.0) {
  }
  EXPECT_GE(watch.elapsed().cpu_ms, 5.0);
}

}  // namespace
}  // namespace lockbox
