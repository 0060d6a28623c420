// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/simulator.hpp"

#include <string>
#include <utility>

#include "lockbox/core/error.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {

Simulator::Simulator(const KinematicTree& tree, const PinholeCamera& camera, PlacedScene scene,
                     const SensorModel& sensor, std::uint64_t seed, const Executor& executor)
    : tree_(tree),
      scene_(std::move(scene)),
      sensor_(sensor, camera, seed, executor),
      renderer_(sensor_.sample_camera(), executor) {}

void Simulator::simulate(const State& state, std::uint64_t index, DepthFrame& frame) {
  if (!state.known || !state.configuration.T_camera_base.matrix().allFinite() ||
      !state.configuration.q.allFinite()) {
    throw InputError("state at " + std::to_string(state.stamp) + " s",
                     "the pose or a joint position is missing; a run can be simulated only if "
                     "every state is complete");
  }
  forward_kinematics(tree_, state.configuration, T_camera_body_);
  items_.clear();
  for (std::size_t b = 0; b < tree_.bodies.size(); ++b) {
    items_.push_back(body_item(tree_, b, T_camera_body_[b]));
  }
  scene_.append_items(state, items_);
  renderer_.render(items_, clean_);
  sensor_.measure(clean_, index, frame);
  frame.stamp = state.stamp;
}

}  // namespace lockbox
