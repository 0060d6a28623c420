// SPDX-License-Identifier: BSD-3-Clause
#include "rivals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hypothesis.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

/// Answers that are nearer to each other are one. Unit: of the model's radius. Source: from there
/// they come to the same rest, unless the view does not tell. Doubled, mugs that are turned by some
/// degrees are one answer.
constexpr double kAnotherAnswer = 0.15;
/// The same of large models. Unit: metres. Source: answers have come to rest; where a frontal view
/// shows of a chest of drawers nothing but fronts, they rest wherever its carcass was put behind
/// them. Doubled, one that was 40 mm too far back is believed.
constexpr double kMostOfOneAnswer = 0.02;

double least_apart(const ModelExtent& extent) {
  return std::min(kAnotherAnswer * extent.radius, kMostOfOneAnswer);
}

}  // namespace

double farthest_move(const ModelExtent& extent, std::span<const Eigen::Isometry3d> symmetries,
                     const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& symmetry : symmetries) {
    const Eigen::Isometry3d move = to.inverse() * from * symmetry;
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3d way((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
      const Eigen::Vector3d p = extent.centre + (way * extent.sides.array()).matrix();
      farthest = std::max(farthest, (move * p - p).norm());
    }
    least = std::min(least, farthest);
  }
  return least;
}

void sort_best_first(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
}

void compare(const ModelExtent& extent, std::span<const Eigen::Isometry3d> symmetries,
             std::vector<Candidate>& candidates) {
  std::vector<double> others;
  for (Candidate& candidate : candidates) {
    const Eigen::Isometry3d& pose = candidate.configuration.T_camera_base;
    others.clear();
    // What is not in view may be as far away as what is.
    double squares =
        std::exp(log_odds(least_evidence(), candidate.evidence)) * pose.translation().squaredNorm();
    for (const Candidate& other : candidates) {
      const double move =
          farthest_move(extent, symmetries, pose, other.configuration.T_camera_base);
      if (move < least_apart(extent)) continue;
      others.push_back(other.evidence);
      squares += std::exp(log_odds(other.evidence, candidate.evidence)) * move * move;
    }
    candidate.belief = belief(candidate.evidence, others);
    candidate.rival_distance = std::sqrt(candidate.belief * squares);
    const Configuration& first = candidates.front().configuration;
    const double move = farthest_move(extent, symmetries, first.T_camera_base, pose);
    candidate.distance = move < least_apart(extent) ? 0.0 : move;
    candidate.is_in_place_of_first = place_distance(extent, first, candidate.configuration) < 1.0;
  }
}

}  // namespace lockbox
