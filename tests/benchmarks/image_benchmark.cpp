// SPDX-License-Identifier: BSD-3-Clause
// What the likelihood of the image costs: the last step of a registration of the shipped lockbox,
// and the search for one joint of low prominence.
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/terms/edge_term.hpp"
#include "lockbox/terms/low_prominence.hpp"
#include "registration_scene.hpp"

namespace lockbox {
namespace {

constexpr int kViewColumns = 320;

void edge_term(benchmark::State& state) {
  const RegistrationScene& scene = shipped_lockbox();
  const View& view = scene.views.front();
  BodyPoses poses;
  std::vector<BodyJacobian> jacobians;
  forward_kinematics(scene.model.tree, view.truth, poses);
  body_jacobians(scene.model.tree, poses, jacobians);
  VisibleSurface surface;
  surface.render(scene.model, poses, view.cloud.camera(), kViewColumns, Executor(1));
  EdgeTerm term(scene.model.tree, {}, Executor(static_cast<int>(state.range(0))));
  const ContinuedEdges none;
  for (auto _ : state) term.linearize(view.cloud, surface, none, kAllPatches, poses, jacobians);
  state.counters["pixels"] = term.pixels();
}

void low_prominence(benchmark::State& state) {
  const RegistrationScene& scene = shipped_lockbox();
  const View& view = scene.views.front();
  const int joint = joint_index(scene.model.tree, "slider");
  const int slider = scene.model.tree.joints[static_cast<std::size_t>(joint)].variable;
  LowProminence finder(scene.model, {}, Executor(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        finder.find_near(view.cloud, view.truth, slider, view.truth.q[slider]));
  }
}

BENCHMARK(edge_term)->Apply(on_one_and_two_threads);
BENCHMARK(low_prominence)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lockbox
