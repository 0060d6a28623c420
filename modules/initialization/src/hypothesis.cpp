// SPDX-License-Identifier: BSD-3-Clause
#include "hypothesis.hpp"

#include <algorithm>

namespace lockbox {
namespace {

constexpr double kApartMetres = 0.04;
constexpr double kApartRadians = 0.15;

bool are_apart(const Hypothesis& a, const Hypothesis& b) {
  const Eigen::Isometry3d difference =
      a.configuration.T_camera_base.inverse() * b.configuration.T_camera_base;
  return difference.translation().norm() >= kApartMetres ||
         Eigen::AngleAxisd(difference.linear()).angle() >= kApartRadians;
}

}  // namespace

double place_distance(const ModelExtent& extent, const Configuration& a, const Configuration& b) {
  return (a.T_camera_base * extent.centre - b.T_camera_base * extent.centre).norm() / extent.radius;
}

std::vector<Hypothesis> best_apart(std::vector<Hypothesis> hypotheses, const Selection& selection,
                                   const ModelExtent& extent) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
  std::vector<Hypothesis> kept;
  for (const Hypothesis& hypothesis : hypotheses) {
    const double best = hypotheses.front().score;
    if (kept.size() == selection.most ||
        (best > 0.0 && hypothesis.score < selection.least_share * best)) {
      break;
    }
    const bool is_new = std::all_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return are_apart(hypothesis, other);
    });
    const auto there = std::count_if(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return place_distance(extent, hypothesis.configuration, other.configuration) <
             selection.place;
    });
    if (is_new && static_cast<std::size_t>(there) < selection.most_in_place) {
      kept.push_back(hypothesis);
    }
  }
  return kept;
}

}  // namespace lockbox
