// SPDX-License-Identifier: BSD-3-Clause
#include "alternatives.hpp"

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

Alternative::Kind kind_of(const Candidate& other, const Candidate& answer) {
  return other.is_in_place_of_first && answer.is_in_place_of_first ? Alternative::Kind::flip
                                                                   : Alternative::Kind::elsewhere;
}

}  // namespace

std::vector<Alternative> alternatives_to(const Candidate& answer,
                                         const std::vector<Candidate>& candidates,
                                         const TrackerOptions& options, const MotionMetric& moves) {
  std::vector<Alternative> found;
  const auto are_one = [&](const Configuration& a, const Configuration& b) {
    return moves.between(a, b) <= options.most_rival_distance;
  };
  const auto is_known = [&](const Configuration& configuration) {
    return are_one(answer.configuration, configuration) ||
           std::ranges::any_of(found, [&](const Alternative& known) {
             return are_one(known.configuration, configuration);
           });
  };
  double told = answer.belief;
  for (const Candidate& other : candidates) {
    if (found.size() == options.most_alternatives) break;
    const double apart = std::max(other.distance, answer.distance);
    const bool is_needed = std::sqrt(other.belief) * apart > options.most_rival_distance ||
                           told < options.convincing_belief;
    if (apart == 0.0 || !is_needed || is_known(other.configuration)) continue;
    told += other.belief;
    found.push_back({kind_of(other, answer), other.configuration, other.belief});
  }
  return found;
}

}  // namespace lockbox
