// SPDX-License-Identifier: BSD-3-Clause
// The shipped lockbox at 640 x 480: the model alone, as the tracker draws it, and whole frames of
// each sensor, in the room with the arm. The argument is the number of threads.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

#include "lockbox/model/articulated_model.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"
#include "lockbox/simulation/simulator.hpp"
#include "lockbox/simulation/trajectory.hpp"

namespace lockbox {
namespace {

const std::string kShare = LOCKBOX_SHARE_DIRECTORY;
const PinholeCamera kCamera{640, 480, 575.8, 575.8, 319.5, 239.5};

void draw_model(benchmark::State& state, const PinholeCamera& camera) {
  const KinematicTree tree = load_kinematic_tree(kShare + "/models/lockbox/lockbox.urdf");
  const auto run = generate_trajectory(tree);
  std::vector<Eigen::Isometry3d> T_camera_body;
  forward_kinematics(tree, run[run.size() / 2].configuration, T_camera_body);
  std::vector<RenderItem> items;
  std::size_t triangles = 0;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    items.push_back(body_item(tree, b, T_camera_body[b]));
    triangles += tree.bodies[b].mesh.triangles.size();
  }
  DepthRenderer renderer(camera, Executor(static_cast<int>(state.range(0))));
  RenderedDepth image;
  for (auto _ : state) {
    renderer.render(items, image);
    benchmark::DoNotOptimize(image.depth.data());
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

void simulate_frames(benchmark::State& state, const std::string& sensor) {
  const KinematicTree tree = load_kinematic_tree(kShare + "/models/lockbox/lockbox.urdf");
  const auto run = generate_trajectory(tree);
  const PlacedScene scene(read_scene(kShare + "/scenes/room_with_arm.yaml"), run);
  Simulator simulator(tree, kCamera, scene, sensor_model(sensor), 1,
                      Executor(static_cast<int>(state.range(0))));
  DepthFrame frame;
  std::size_t i = 0;
  for (auto _ : state) {
    simulator.simulate(run[i % run.size()], i, frame);
    i += 7;
  }
  state.SetItemsProcessed(state.iterations());
}

void on_one_and_two_threads(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(draw_model, full, kCamera)->Apply(on_one_and_two_threads);
BENCHMARK_CAPTURE(draw_model, half, reduced(kCamera, 2))->Apply(on_one_and_two_threads);
BENCHMARK_CAPTURE(simulate_frames, primesense, "primesense")->Apply(on_one_and_two_threads);
BENCHMARK_CAPTURE(simulate_frames, white, "white")->Apply(on_one_and_two_threads);
BENCHMARK_CAPTURE(simulate_frames, ideal, "ideal")->Apply(on_one_and_two_threads);

}  // namespace
}  // namespace lockbox
