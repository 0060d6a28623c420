// SPDX-License-Identifier: BSD-3-Clause
// How joints stand, as lines beside the picture, and sliders that set them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lockbox/model/configuration.hpp"
#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// How a joint stands.
struct JointLine {
  std::string text;                  ///< name, position, standard deviation, limits
  std::optional<std::size_t> joint;  ///< none: the line tells how many more there are
};

/// The joints that move by themselves, in the order of the file, as many as fit on a window. sigma:
/// by joint, radians or metres; empty if it is not told.
std::vector<JointLine> joint_lines(const KinematicTree& tree, const Configuration& configuration,
                                   const std::vector<double>& sigma);

/// Returns the lines as one text, each after a line break.
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
