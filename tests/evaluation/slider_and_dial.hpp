// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/model/states_file.hpp"

namespace lockbox {

/// A base with a part that slides along x (0 .. 0.2 m) and one that turns on and on about z.
inline KinematicTree slider_and_dial() {
  KinematicTree tree;
  tree.name = "slider_and_dial";
  Joint slider;
  slider.name = "slider";
  slider.type = JointType::prismatic;
  slider.axis = Eigen::Vector3d::UnitX();
  slider.upper = 0.2;
  slider.child_body = 1;
  slider.variable = 0;
  Joint dial;
  dial.name = "dial";
  dial.type = JointType::continuous;
  dial.lower = -std::numeric_limits<double>::infinity();
  dial.upper = std::numeric_limits<double>::infinity();
  dial.child_body = 2;
  dial.variable = 1;
  tree.joints = {slider, dial};
  tree.bodies.resize(3);
  tree.bodies[1].parent_joint = 0;
  tree.bodies[2].parent_joint = 1;
  tree.variable_joint = {0, 1};
  tree.file_order = {0, 1};
  return tree;
}

inline State state_at(double stamp, const Eigen::Vector3d& translation, double slider, double dial,
                      const std::string& status = "tracking") {
  State state;
  state.stamp = stamp;
  state.configuration.T_camera_base.translation() = translation;
  state.configuration.q = Eigen::Vector2d(slider, dial);
  state.status = status;
  return state;
}

}  // namespace lockbox
