// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// Returns by body 1 where the joint variable moves it while the held body stays where it is.
std::vector<std::uint8_t> moved_bodies(const KinematicTree& tree, int variable,
                                       std::size_t held = 0);

}  // namespace lockbox
