// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace lockbox {
namespace {

TEST(ExecutorTest, VisitsEveryIndexOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    const Executor executor(threads);
    std::vector<std::atomic<int>> visits(1000);
    executor.for_each(visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const auto& count : visits) {
      EXPECT_EQ(count.load(), 1);
    }
  }
}

TEST(ExecutorTest, VisitsEveryIndexOfSeveralLoopsOnce) {
  for (const int threads : {1, 2, 3, 8, 100}) {
    const Executor executor(threads);
    std::vector<std::vector<std::atomic<int>>> visits(4);
    const std::vector<std::size_t> counts{1, 0, 7, 100};
    for (std::size_t k = 0; k < counts.size(); ++k) {
      visits[k] = std::vector<std::atomic<int>>(counts[k]);
    }
    const auto visit = [&](std::size_t loop) {
      return [&visits, loop](std::size_t i) { ++visits[loop].at(i); };
    };
    const auto first = visit(0);
    const auto second = visit(1);
    const auto third = visit(2);
    const auto last = visit(3);
    executor.for_each(
        {{counts[0], first}, {counts[1], second}, {}, {counts[2], third}, {counts[3], last}});
    for (const auto& loop : visits) {
      for (const auto& count : loop) EXPECT_EQ(count.load(), 1) << threads;
    }
  }
}

TEST(ExecutorTest, NothingToDoIsDone) {
  const Executor executor(2);
  executor.for_each(0, [](std::size_t) { FAIL(); });
  executor.for_each({});
}

TEST(ExecutorTest, ChunksCoverTheRangeWithoutOverlap) {
  const Executor executor(2);
  std::vector<std::pair<std::size_t, std::size_t>> ranges(chunk_count(103, 10));
  executor.for_each_chunk(103, 10, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    ranges[chunk] = {begin, end};
  });
  ASSERT_EQ(ranges.size(), 11U);
  for (std::size_t chunk = 0; chunk < ranges.size(); ++chunk) {
    EXPECT_EQ(ranges[chunk].first, 10 * chunk);
    EXPECT_EQ(ranges[chunk].second, std::min<std::size_t>(10 * chunk + 10, 103));
  }
}

TEST(ExecutorTest, WorkersHaveIndicesBelowTheThreadCount) {
  for (const int threads : {1, 3}) {
    const Executor executor(threads);
    std::atomic<std::size_t> largest{0};
    executor.for_each(500, [&](std::size_t) {
      const std::size_t worker = Executor::worker();
      std::size_t seen = largest.load();
      while (worker > seen && !largest.compare_exchange_weak(seen, worker)) {
      }
    });
    EXPECT_LT(largest.load(), static_cast<std::size_t>(threads));
  }
}

TEST(ExecutorTest, TakesNoMoreThreadsThanTheMachineHasUseFor) {
  const Executor executor(100000);
  EXPECT_GE(executor.threads(), static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_LT(executor.threads(), 10000);
  std::atomic<int> visits{0};
  executor.for_each(1000, [&](std::size_t) { ++visits; });
  EXPECT_EQ(visits.load(), 1000);
}

TEST(ExecutorTest, AsManyThreadsWorkAsWereAskedForWhateverOthersAskedFor) {
  testing::internal::CaptureStderr();
  Executor(2).for_each(2, [](std::size_t) {});
  constexpr std::size_t kThreads = 6;
  std::atomic<std::size_t> arrived{0};
  std::atomic<bool> all_came{false};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  Executor(kThreads).for_each(kThreads, [&](std::size_t) {
    if (++arrived == kThreads) all_came = true;
    while (!all_came && std::chrono::steady_clock::now() < give_up) std::this_thread::yield();
  });
  EXPECT_TRUE(all_came) << arrived << " threads came";
  EXPECT_LE(Executor().threads(), static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ExecutorTest, LoopsSeeWhatWasWrittenBeforeThem) {
  // Without atomics: also what ThreadSanitizer checks the loop by.
  const Executor executor(4);
  std::vector<int> values(1000, 1);
  for (int loop = 1; loop <= 10; ++loop) {
    executor.for_each(values.size(), [&](std::size_t i) { values[i] *= 2; });
    EXPECT_EQ(std::accumulate(values.begin(), values.end(), 0), 1000 << loop);
  }
}

TEST(ExecutorTest, ExceptionsReachTheCaller) {
  const Executor executor(2);
  EXPECT_THROW(executor.for_each(8,
                                 [](std::size_t i) {
                                   if (i == 5) throw std::runtime_error("five");
                                 }),
               std::runtime_error);
}

TEST(ExecutorTest, AStoppedLoopLeavesOutWhatHasNotBegun) {
  const Executor executor(2);
  std::atomic<int> begun{0};
  EXPECT_THROW(executor.for_each(1000,
                                 [&](std::size_t) {
                                   ++begun;
                                   executor.stop();
                                 }),
               Stopped);
  EXPECT_LE(begun.load(), 2);
}

TEST(ExecutorTest, StaysStoppedUntilItIsResumed) {
  const Executor executor(2);
  Executor copy(1);
  copy = executor;
  executor.stop();
  EXPECT_THROW(copy.for_each(1, [](std::size_t) {}), Stopped);
  executor.resume();
  EXPECT_NO_THROW(copy.for_each(1, [](std::size_t) {}));
}

TEST(ExecutorTest, ARequestStopsLoopsAsLongAsItLasts) {
  std::atomic<bool> requested{false};
  const Executor executor(2, Priority::normal, [&] { return requested.load(); });
  std::atomic<int> begun{0};
  EXPECT_THROW(executor.for_each(1000,
                                 [&](std::size_t) {
                                   ++begun;
                                   requested = true;
                                 }),
               Stopped);
  EXPECT_LE(begun.load(), 2);
  requested = false;
  EXPECT_NO_THROW(executor.for_each(1, [](std::size_t) {}));
}

TEST(ExecutorTest, OneOfLowPriorityVisitsEveryIndexBesideAnother) {
  const Executor executor(2);
  const Executor beside(2, Priority::low);
  std::vector<std::atomic<int>> visits(1000);
  std::thread other([&] { beside.for_each(visits.size(), [&](std::size_t i) { ++visits[i]; }); });
  executor.for_each(visits.size(), [&](std::size_t i) { ++visits[i]; });
  other.join();
  for (const auto& count : visits) EXPECT_EQ(count.load(), 2);
}

TEST(ExecutorTest, WorkersLeaveALoopOfLowPriorityForAnother) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core has no workers";
  const Executor executor(2);
  const Executor beside(2, Priority::low);
  std::atomic<bool> has_worker{false};
  std::atomic<bool> is_over{false};
  std::thread other([&] {
    beside.for_each(200000, [&](std::size_t) {
      if (Executor::worker() > 0) has_worker = true;
      if (!is_over) std::this_thread::sleep_for(std::chrono::microseconds(100));
    });
  });
  while (!has_worker) std::this_thread::yield();
  // Both bodies wait for each other: one thread alone cannot be done with the loop.
  std::atomic<int> arrived{0};
  executor.for_each(2, [&](std::size_t) {
    ++arrived;
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (arrived < 2 && std::chrono::steady_clock::now() < latest) std::this_thread::yield();
    EXPECT_EQ(arrived, 2);
  });
  is_over = true;
  other.join();
}

}  // namespace
}  // namespace lockbox
