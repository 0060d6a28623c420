// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/simulation/simulator.hpp"

#include <string>
#include <utility>

#include "deviating_view.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/rendering/body_item.hpp"

namespace lockbox {

Simulator::Simulator(const KinematicTree& tree, const PinholeCamera& camera, PlacedScene scene,
                     const SensorModel& sensor, std::uint64_t seed, const Executor& executor,
                     const SensorDeviation& deviation)
    : tree_(tree),
      scene_(std::move(scene)),
      sensor_(sensor, camera, seed, executor),
      renderer_(sensor_.sample_camera(), executor) {
  if (!deviation.is_any()) return;
  view_ = std::make_unique<simulation::DeviatingView>(camera, sensor_.sample_camera(), deviation,
                                                      executor);
  renderer_.set_camera(view_->camera());
}

Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

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
  renderer_.render(items_, view_ ? scene_depth_ : clean_);
  if (view_) view_->measure(scene_depth_, clean_);
  sensor_.measure(clean_, index, frame);
  frame.stamp = state.stamp;
}

Eigen::Isometry3d Simulator::apparent_base() const {
  if (!view_) return T_camera_body_.front();
  return view_->apparent_motion(scene_depth_, clean_, static_cast<int>(tree_.bodies.size())) *
         T_camera_body_.front();
}

}  // namespace lockbox
