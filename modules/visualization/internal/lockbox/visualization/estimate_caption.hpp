// SPDX-License-Identifier: BSD-3-Clause
// What is known of the model, as lines below a picture of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "lockbox/visualization/captioned_picture.hpp"
#include "lockbox/visualization/shown_estimate.hpp"

namespace lockbox {

/// The title, the belief, where the base is, and how joints stand (joint_panel.hpp), each with the
/// colour of the body that it moves; of a model that is not known, title and belief alone.
/// colors: of bodies, [0, 1]; none where a body cannot be seen.
std::vector<CaptionLine> estimate_caption(
    const KinematicTree& tree, const ShownEstimate& estimate, const std::string& title,
    const std::vector<std::optional<Eigen::Vector3f>>& colors);

}  // namespace lockbox
