// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lockbox/model/configuration.hpp"
#include "model_extent.hpp"

namespace lockbox {

/// A guess at where the model is, on its way to a candidate.
struct Hypothesis {
  Configuration configuration;
  std::vector<std::uint8_t> bodies;  ///< whose place is known
  double score = 0.0;                ///< of one stage; the larger, the more convincing
  std::size_t held = 0;              ///< the body that stays where it is while joints are sought
};

/// What a stage keeps of its hypotheses.
struct Selection {
  double least_share;  ///< of the best one's score, if that is positive
  std::size_t most;
  double place;               ///< radii of the model across: what counts as one place
  std::size_t most_in_place;  ///< so that none crowds out all others
  std::size_t most_alike;     ///< in one place, turned by less than 45 degrees from each other
};

/// How far apart the model's middle is, in radii of the model; at less than 2 balls around it
/// overlap.
double place_distance(const ModelExtent& extent, const Configuration& a, const Configuration& b);

/// Whether one of them has that base: nearer than half of what makes two answers, and turned by
/// less than a hundredth of a radian.
bool has_base(const ModelExtent& extent, const std::vector<Hypothesis>& hypotheses,
              const Eigen::Isometry3d& T_camera_base);

/// Whether their bases are 0.15 radians or twice what makes two answers from each other.
bool are_apart(const ModelExtent& extent, const Hypothesis& a, const Hypothesis& b);

/// The best hypotheses, best first, whose bases are apart.
std::vector<Hypothesis> best_apart(std::vector<Hypothesis> hypotheses, const Selection& selection,
                                   const ModelExtent& extent);

}  // namespace lockbox
