// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/random_frame.hpp"

#include "lockbox/evaluation/bound.hpp"
#include "lockbox/simulation/simulator.hpp"

namespace lockbox {

RandomFrame simulate_random_frame(const ArticulatedModel& model, const PinholeCamera& camera,
                                  const SensorModel& sensor, std::uint64_t seed,
                                  std::uint64_t number, const Executor& executor) {
  RandomFrame result;
  result.view = draw_random_scene(model, camera, seed, number);
  const State& truth = result.view.truth;
  const PlacedScene placed(result.view.scene, {truth});
  Simulator(model.tree, camera, placed, sensor, seed, executor)
      .simulate(truth, number, result.frame);
  std::vector<RenderItem> scenery;
  placed.append_items(truth, scenery);
  DepthInformation information(model.tree, camera, sensor, executor);
  result.bound = bound_sigma(information.compute(truth.configuration, scenery));
  return result;
}

}  // namespace lockbox
