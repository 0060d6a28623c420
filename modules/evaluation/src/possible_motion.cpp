// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/possible_motion.hpp"

#include "lockbox/terms/collision_term.hpp"

namespace lockbox {

std::vector<State> possible_motion(const ArticulatedModel& model, TrajectoryOptions options) {
  CollisionTerm collision(model, CollisionOptions{});
  BodyPoses poses;
  options.is_possible = [&](const Configuration& configuration) {
    forward_kinematics(model.tree, configuration, poses);
    return collision.cost(model, poses) == 0.0;
  };
  return generate_trajectory(model.tree, options);
}

}  // namespace lockbox
