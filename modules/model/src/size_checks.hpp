// SPDX-License-Identifier: BSD-3-Clause
// Lengths of a model that are probably not in metres.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lockbox/model/kinematic_tree.hpp"
#include "visual_extent.hpp"

namespace lockbox {

/// What is called with a link or joint and what is wrong with it.
using Complaint = std::function<void(const std::string& name, const std::string& problem)>;

struct SizeComplaints {
  Complaint refuse_link;  ///< must throw
  Complaint warn_of_link;
  Complaint warn_of_joint;
};

/// Compares the sizes and places of all visuals, and the origins of joints, against each other and
/// against what depth cameras see. A link of more than 20 m is refused. Each message names the
/// probable unit and what mends it. mesh_scale: see LoadOptions; is_bare: the model is a mesh file.
void check_sizes(const std::vector<VisualExtent>& visuals, const KinematicTree& tree,
                 double mesh_scale, bool is_bare, const SizeComplaints& complaints);

}  // namespace lockbox
