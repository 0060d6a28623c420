// SPDX-License-Identifier: BSD-3-Clause
// How joints stand, as lines beside the picture, and sliders that set them.
#pragma once

#include <string>
#include <vector>

#include "lockbox/model/configuration.hpp"
#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The joints that move by themselves, in the order of the file, one a line: name, position,
/// standard deviation, limits. sigma: by joint, radians or metres; empty if it is not told.
std::string joint_panel(const KinematicTree& tree, const Configuration& configuration,
                        const std::vector<double>& sigma);

/// Sliders for the variables of these joints, in degrees and millimetres, in the order of the file.
std::vector<SceneSlider> joint_sliders(const KinematicTree& tree,
                                       const Configuration& configuration);

/// Takes over where the user has moved a slider of joint_sliders().
void move_joint(const KinematicTree& tree, const SliderMove& move, Configuration& configuration);

}  // namespace lockbox
