// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/run_bounds.hpp"

#include <limits>

#include "lockbox/evaluation/bound.hpp"

namespace lockbox {

std::vector<FrameBound> compute_run_bounds(const KinematicTree& tree, const std::vector<State>& run,
                                           const PinholeCamera& camera, const SensorModel& sensor,
                                           const PlacedScene& scene, const Executor& executor,
                                           const std::function<void(std::size_t)>& on_frame) {
  DepthInformation information(tree, camera, sensor, executor);
  const Eigen::VectorXd nothing =
      Eigen::VectorXd::Constant(tree.unknowns(), std::numeric_limits<double>::infinity());
  std::vector<FrameBound> bounds;
  std::vector<RenderItem> scenery;
  for (const State& state : run) {
    const bool complete = state.known && state.configuration.q.allFinite();
    if (complete) {
      scenery.clear();
      scene.append_items(state, scenery);
      bounds.push_back(
          {state.stamp, bound_sigma(information.compute(state.configuration, scenery))});
    } else {
      bounds.push_back({state.stamp, nothing});
    }
    if (on_frame) on_frame(bounds.size());
  }
  return bounds;
}

}  // namespace lockbox
