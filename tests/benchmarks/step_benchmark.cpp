// SPDX-License-Identifier: BSD-3-Clause
// One registration step of the shipped lockbox, prediction and cloud in, configuration and
// covariance out, visibility included; and the floor: the bare look-ups of its iterations.
#include "look_up_floor.hpp"
#include "registration_scene.hpp"

namespace lockbox {
namespace {

void registration_step(benchmark::State& state) {
  time_registration(state, shipped_lockbox(), static_cast<int>(state.range(0)));
}

/// Without the likelihood of the image, which no other registration has: at edges, and of joints of
/// low prominence.
void three_terms_step(benchmark::State& state) {
  RegistrationOptions options = all_points();
  options.refine_at_edges = false;
  options.match_low_prominence = false;
  time_registration(state, shipped_lockbox(), static_cast<int>(state.range(0)), options);
}

/// On one thread, by point budget.
void budgeted_step(benchmark::State& state) {
  RegistrationOptions options;
  options.point_budget = static_cast<std::size_t>(state.range(0));
  time_registration(state, shipped_lockbox(), 1, options);
}

/// Pixels that are in the sums of a registration.
std::size_t points_in_sums() {
  const View& view = shipped_lockbox().views.front();
  ArticulatedRegistration registration(shipped_lockbox().model, all_points(), Executor());
  return static_cast<std::size_t>(
      registration.align(view.cloud, view.predicted, kFromPrediction).explained_points);
}

void look_up_floor(benchmark::State& state) {
  const auto threads = static_cast<int>(state.range(0));
  const Executor executor(threads);
  static LookUpFloor floor(shipped_lockbox(), points_in_sums());
  for (auto _ : state) {
    for (int pass = 0; pass < kIterations; ++pass) {
      benchmark::DoNotOptimize(floor.pass(executor));
    }
  }
  const auto points = static_cast<double>(floor.points());
  state.counters["points"] = points;
  state.counters["point_core"] = benchmark::Counter(
      points * kIterations / threads,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(look_up_floor)->Apply(on_one_and_two_threads);
BENCHMARK(registration_step)->Apply(on_one_and_two_threads);
BENCHMARK(three_terms_step)->Apply(on_one_and_two_threads);
BENCHMARK(budgeted_step)
    ->ArgName("points")
    ->Arg(40000)
    ->Arg(20000)
    ->Arg(10000)
    ->Arg(5000)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace lockbox
