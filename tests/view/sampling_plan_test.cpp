// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/view/sampling_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lockbox {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kFocalLength = 300.0;
constexpr int kCell = SamplingDensity::kCellSize;

void draw(RenderedDepth& view, int id, float depth, int left, int top, int right, int bottom) {
  for (int v = top; v < bottom; ++v) {
    for (int u = left; u < right; ++u) {
      view.depth[view.index(u, v)] = depth;
      view.id[view.index(u, v)] = static_cast<std::int16_t>(id);
    }
  }
}

/// A large plate, 200 x 160 pixels, and a small one upon it, 24 x 24; a step within the large one.
RenderedDepth plates() {
  RenderedDepth view;
  view.width = kWidth;
  view.height = kHeight;
  view.drawn = {0, 0, kWidth, kHeight};
  view.depth.assign(static_cast<std::size_t>(kWidth * kHeight),
                    std::numeric_limits<float>::infinity());
  view.id.assign(view.depth.size(), kNothing);
  draw(view, 0, 1.0F, 60, 40, 260, 200);
  draw(view, 0, 0.98F, 204, 100, 212, 108);
  draw(view, 1, 0.97F, 100, 100, 124, 124);
  return view;
}

SamplingDensity planned_of(const RenderedDepth& view, std::size_t budget, double reach,
                           int threads = 1) {
  const Executor executor(threads);
  ViewEdges edges;
  edges.find(view, executor);
  SamplingPlan plan;
  plan.plan(view, edges, 1, kFocalLength, reach, budget, executor);
  return plan.density();
}

SamplingDensity planned(std::size_t budget, double reach = 0.0, int threads = 1) {
  return planned_of(plates(), budget, reach, threads);
}

int spacing_at(const SamplingDensity& density, int u, int v) {
  return density.spacing[static_cast<std::size_t>(v / kCell * density.columns + u / kCell)];
}

/// Samples on the plates.
std::size_t samples(const SamplingDensity& density) {
  const RenderedDepth view = plates();
  std::size_t count = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int spacing = spacing_at(density, u, v);
      if (spacing == 0 || view.id[view.index(u, v)] == kNothing) continue;
      const int first = SamplingDensity::first_sample(spacing);
      count += u % spacing == first && v % spacing == first ? 1 : 0;
    }
  }
  return count;
}

TEST(SamplingPlan, NeedsToKnowOnlyWhereTheViewIsDrawn) {
  RenderedDepth view = plates();
  view.drawn = {60, 40, 200, 160};  // as tight as can be
  for (const std::size_t budget : {std::size_t{300}, std::size_t{2000}, std::size_t{100000}}) {
    EXPECT_EQ(planned_of(view, budget, 0.1).spacing, planned(budget, 0.1).spacing);
  }
}

TEST(SamplingPlan, SpendsTheBudgetAndNotMore) {
  for (const std::size_t budget : {1500U, 3000U, 6000U, 8000U, 12000U}) {
    const std::size_t spent = samples(planned(budget));
    EXPECT_LE(spent, budget);
    EXPECT_GT(spent, budget / 3) << budget;  // contours share their cells with what lies beside
  }
}

TEST(SamplingPlan, LooksCloselyWhereBodiesEndAndWhereTheyBend) {
  const SamplingDensity density = planned(6000);
  EXPECT_EQ(spacing_at(density, 180, 60), 4);  // in the middle of the large plate
  for (const auto& [u, v] : {std::pair{60, 120}, std::pair{100, 112}, std::pair{208, 104}}) {
    EXPECT_LE(spacing_at(density, u, v), 2) << u << ", " << v;
  }
}

/// More points at its edges do not tell how a large plate is turned.
TEST(SamplingPlan, DoesNotSpendAllOnEdges) {
  for (const std::size_t budget : {3000U, 8000U, 12000U}) {
    const SamplingDensity density = planned(budget);
    for (const auto& [u, v] : {std::pair{180, 60}, std::pair{80, 180}, std::pair{240, 140}}) {
      EXPECT_LE(spacing_at(density, u, v), 4 * spacing_at(density, 100, 112)) << budget;
      EXPECT_LE(spacing_at(density, u, v), 4) << budget;
    }
  }
}

TEST(SamplingPlan, SmallBodiesComeFirst) {
  const SamplingDensity density = planned(2500);
  EXPECT_LT(spacing_at(density, 100, 112), spacing_at(density, 60, 120));
}

TEST(SamplingPlan, EnoughForAllTakesAll) {
  const SamplingDensity density = planned(1000000);
  EXPECT_EQ(samples(density), 200U * 160U);
}

TEST(SamplingPlan, LooksAsFarBesideTheModelAsItMayBe) {
  EXPECT_EQ(spacing_at(planned(6000), 20, 120), 0);
  // 0.12 m at the plate are 36 pixels.
  EXPECT_EQ(spacing_at(planned(6000, 0.12), 30, 120), kCell);
  EXPECT_EQ(spacing_at(planned(6000, 0.12), 8, 120), 0);
}

TEST(SamplingPlan, OfNothingIsNothing) {
  RenderedDepth view = plates();
  std::fill(view.id.begin(), view.id.end(), kNothing);
  std::fill(view.depth.begin(), view.depth.end(), std::numeric_limits<float>::infinity());
  const SamplingDensity density = planned_of(view, 6000, 0.1);
  EXPECT_TRUE(std::all_of(density.spacing.begin(), density.spacing.end(),
                          [](std::uint8_t spacing) { return spacing == 0; }));
}

TEST(SamplingPlan, IsTheSameForAnyNumberOfThreads) {
  const SamplingDensity one = planned(2000, 0.05, 1);
  for (const int threads : {2, 3}) {
    EXPECT_EQ(planned(2000, 0.05, threads).spacing, one.spacing);
  }
}

}  // namespace
}  // namespace lockbox
