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

/// How many pages the sliders of these joints need, as many a page as fit on a window; 0: there are
/// none.
std::size_t slider_pages(const KinematicTree& tree);

/// "joints 1 to 14 of 39; page keys: the others"; empty where one page holds all.
std::string slider_page_text(const KinematicTree& tree, std::size_t page);

/// Sliders for the variables of the joints of a page, counted from 0, in degrees and millimetres,
/// with their limits, in the order of the file.
std::vector<SceneSlider> joint_sliders(const KinematicTree& tree,
                                       const Configuration& configuration, std::size_t page);

/// Takes over where the user has moved a slider of joint_sliders() of that page.
void move_joint(const KinematicTree& tree, std::size_t page, const SliderMove& move,
                Configuration& configuration);

}  // namespace lockbox
