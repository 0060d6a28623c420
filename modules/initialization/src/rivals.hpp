// SPDX-License-Identifier: BSD-3-Clause
// Other answers that may be the right one: turned back to front, or elsewhere.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "lockbox/initialization/initializer.hpp"
#include "model_extent.hpp"

namespace lockbox {

/// Metres that the farthest corner of the box around the model moves from one pose of the base to
/// the other, or to one that looks the same. symmetries: of the model, the identity among them.
double farthest_move(const ModelExtent& extent, std::span<const Eigen::Isometry3d> symmetries,
                     const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// Puts the candidates with most evidence first.
void sort_best_first(std::vector<Candidate>& candidates);

/// Sets belief, rival_distance, distance and is_in_place_of_first of each: one of them is right, or
/// the object is not in view. Those that are hardly apart are one answer.
void compare(const ModelExtent& extent, std::span<const Eigen::Isometry3d> symmetries,
             std::vector<Candidate>& candidates);

}  // namespace lockbox
