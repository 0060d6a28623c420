// SPDX-License-Identifier: BSD-3-Clause
#include "hypothesis.hpp"

#include <algorithm>

namespace lockbox {
namespace {

/// Bases that are nearer to each other are tried once: fronts in one plane say the same. Unit: of
/// what makes two answers (least_apart). Source: half of it. Doubled, a base that is 2 cm off is
/// not tried.
constexpr double kSameBase = 0.5;
constexpr double kSameTurn = 0.01;  // radians: the same of turns

/// Radians. Source: half of what a square board is turned by to where it looks the same. Doubled,
/// such turns crowd out the right one.
constexpr double kAlike = 0.785;
/// Of two hypotheses whose bases are nearer to each other, in both, only the better one is kept.
/// Unit: of what makes two answers (least_apart), and radians. Source: not recorded. Doubled, one
/// that is 7 cm from a better one is not followed.
constexpr double kApartBases = 2.0;
constexpr double kApartRadians = 0.15;

double turn_between(const Hypothesis& a, const Hypothesis& b) {
  return Eigen::Quaterniond(a.configuration.T_camera_base.linear())
      .angularDistance(Eigen::Quaterniond(b.configuration.T_camera_base.linear()));
}

}  // namespace

bool are_apart(const ModelExtent& extent, const Hypothesis& a, const Hypothesis& b) {
  const Eigen::Isometry3d difference =
      a.configuration.T_camera_base.inverse() * b.configuration.T_camera_base;
  return difference.translation().norm() >= kApartBases * least_apart(extent) ||
         Eigen::AngleAxisd(difference.linear()).angle() >= kApartRadians;
}

double place_distance(const ModelExtent& extent, const Configuration& a, const Configuration& b) {
  return (a.T_camera_base * extent.centre - b.T_camera_base * extent.centre).norm() / extent.radius;
}

bool has_base(const ModelExtent& extent, const std::vector<Hypothesis>& hypotheses,
              const Eigen::Isometry3d& T_camera_base) {
  return std::any_of(hypotheses.begin(), hypotheses.end(), [&](const Hypothesis& hypothesis) {
    const Eigen::Isometry3d between =
        T_camera_base.inverse() * hypothesis.configuration.T_camera_base;
    return between.translation().norm() < kSameBase * least_apart(extent) &&
           Eigen::AngleAxisd(between.linear()).angle() < kSameTurn;
  });
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
      return are_apart(extent, hypothesis, other);
    });
    std::size_t there = 0;
    std::size_t alike = 0;
    for (const Hypothesis& other : kept) {
      if (place_distance(extent, hypothesis.configuration, other.configuration) >= selection.place)
        continue;
      ++there;
      if (turn_between(hypothesis, other) < kAlike) ++alike;
    }
    if (is_new && there < selection.most_in_place && alike < selection.most_alike) {
      kept.push_back(hypothesis);
    }
  }
  return kept;
}

}  // namespace lockbox
