// SPDX-License-Identifier: BSD-3-Clause
// The cost of a registration step against the number of points, links and joints; one thread.
#include "box_wall.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "registration_scene.hpp"

namespace lockbox {
namespace {

/// The lockbox by cameras of the same view: a quarter and a sixteenth of the pixels, and four times
/// as many. Beyond 640 columns the z-buffer stays as it is.
void points(benchmark::State& state) {
  const auto columns = static_cast<int>(state.range(0));
  const PinholeCamera camera = columns > kPrimeSense.width
                                   ? refined(kPrimeSense, columns / kPrimeSense.width)
                                   : reduced(kPrimeSense, kPrimeSense.width / columns);
  const RegistrationScene scene = shipped_lockbox(camera);
  time_registration(state, scene, 1);
  state.counters["point"] =
      benchmark::Counter(state.counters["points"], benchmark::Counter::kIsIterationInvariantRate |
                                                       benchmark::Counter::kInvert);
}

/// Equal points on more links, that one variable moves.
void links(benchmark::State& state) {
  const RegistrationScene scene = box_wall_scene(static_cast<int>(state.range(0)), 1);
  time_registration(state, scene, 1);
}

/// Equal links, moved by more variables.
void joints(benchmark::State& state) {
  const RegistrationScene scene = box_wall_scene(64, static_cast<int>(state.range(0)));
  time_registration(state, scene, 1);
}

BENCHMARK(points)
    ->ArgName("columns")
    ->Arg(160)
    ->Arg(320)
    ->Arg(640)
    ->Arg(1280)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(links)->Arg(1)->Arg(8)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(joints)->Arg(1)->Arg(8)->Arg(63)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lockbox
