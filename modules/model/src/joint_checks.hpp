// SPDX-License-Identifier: BSD-3-Clause
// Joints that are sound, but hardly what their author meant.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// Called with a joint's name and what is strange about it.
using JointRemark = std::function<void(const std::string& joint, const std::string& text)>;

/// Limits that look like degrees or millimetres, and joints that cannot move. largest_link: metres.
void check_limits(const KinematicTree& tree, double largest_link, const JointRemark& warn);

/// Gives each mimic joint the limits that follow from those of the joint that it mimics, and warns
/// of its own ones in the file (lower, upper, by name) where they would have kept it from moving so
/// far.
void set_mimic_limits(const std::map<std::string, std::pair<double, double>>& in_file,
                      KinematicTree& tree, const JointRemark& warn);

}  // namespace lockbox
