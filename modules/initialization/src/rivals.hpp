// SPDX-License-Identifier: BSD-3-Clause
// Other answers that may be the right one: turned back to front, or elsewhere.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "lockbox/initialization/initializer.hpp"
#include "sought_model.hpp"

namespace lockbox {

/// Metres that the farthest corner of the box around the model moves from one pose of the base to
/// the other, or to one that looks the same. symmetries: of the model, the identity among them.
double farthest_move(const ModelExtent& extent, std::span<const Eigen::Isometry3d> symmetries,
                     const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// Whether they are hardly apart, or look the same: where it is that moves, or a base that is round
/// turns about its axis.
bool are_one(const SoughtModel& sought, const Configuration& a, const Configuration& b);

/// Puts the candidates with most evidence first.
void sort_best_first(std::vector<Candidate>& candidates);

/// Sets belief, rival_distance, distance and is_in_place_of_first of each, the best first: one of
/// them is right, or the object is not in view.
void compare(const SoughtModel& sought, std::vector<Candidate>& candidates);

/// Keeps so many that are apart, and one more of each, which may have other joints; the best of
/// them, in their order.
void keep_most_apart(const SoughtModel& sought, std::size_t most,
                     std::vector<Candidate>& candidates);

/// The probability that the model is in the place of the first of them, whichever of those there is
/// right. 0 without any. compared: by compare().
double belief_in_place_of_first(const SoughtModel& sought, const std::vector<Candidate>& compared);

}  // namespace lockbox
