// SPDX-License-Identifier: BSD-3-Clause
// A small mechanism with every kind of joint, and what a camera sees of it.
#pragma once

#include <string>
#include <vector>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/model/articulated_model.hpp"
#include "lockbox/simulation/simulator.hpp"

namespace lockbox {

/// A plate (40 x 40 x 2 cm) in its own x-y plane that carries: `slide`, a block along x; on the
/// block `turn`, an arm about z; on the arm `twist`, a knob about the arm's x (continuous); and
/// `follower`, a second block along y that mimics `slide`. Chains of three, all in contact.
const ArticulatedModel& mechanism();

/// Its links and joints, as elements of a URDF file.
std::vector<std::string> mechanism_elements();

/// The same, or another model, from such elements.
ArticulatedModel load_mechanism(const std::vector<std::string>& elements,
                                const LoadOptions& options);
/// Its kinematic tree alone, without fields.
KinematicTree load_mechanism_tree(const std::vector<std::string>& elements);

/// One body, that no turn and no mirror maps onto itself: sought in a fraction of the time.
const ArticulatedModel& bracket();

/// Seen from about 0.7 m, joints in mid-range, tilted.
Configuration mechanism_start(const ArticulatedModel& model);

/// What a sensor measures of the configuration, before a wall.
DepthFrame measured(const ArticulatedModel& model, const Configuration& configuration,
                    const std::string& sensor, std::uint64_t seed = 1);

TiledCloud cloud_of(const DepthFrame& frame);

}  // namespace lockbox
