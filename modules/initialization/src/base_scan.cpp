// SPDX-License-Identifier: BSD-3-Clause
#include "base_scan.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "lockbox/model/forward_kinematics.hpp"

namespace lockbox {
namespace {

/// Bodies about which the base swings. Source: as many as a chest of drawers has fronts. Doubled,
/// the turns of a wall of doors take twice as long.
constexpr std::size_t kMostCarriers = 8;
/// Positions along a joint, both ends among them. Source: a microwave whose door was right rested
/// 15 degrees from where it was; doors turn by 110 degrees and less. Doubled, each takes twice as
/// long.
constexpr int kSwingSteps = 24;
/// Of these, as many are followed as explain more than those beside them, the best first. Source:
/// a base fits at both sides of a door, and so far open that it is out of sight. Doubled, six are.
constexpr std::size_t kMostPeaks = 3;
/// Metres that surfaces may be off, and the share that is tolerated of what speaks against it, as
/// the base is off by half a step. Source: as for matches (proposer.cpp). Doubled, what lies behind
/// passes for the base.
constexpr double kSwingSlack = 0.02;
constexpr double kSwingTolerance = 0.5;

double explained_pixels(const Agreement& body) {
  return body.explained * body.pixels;
}

/// The bodies of which more is explained than of the base, the most first.
std::vector<std::size_t> carriers(const std::vector<Agreement>& bodies) {
  std::vector<std::size_t> seen(bodies.size());
  std::iota(seen.begin(), seen.end(), std::size_t{0});
  std::erase_if(seen, [&](std::size_t body) {
    return explained_pixels(bodies[body]) <= explained_pixels(bodies.front());
  });
  std::stable_sort(seen.begin(), seen.end(), [&](std::size_t a, std::size_t b) {
    return explained_pixels(bodies[a]) > explained_pixels(bodies[b]);
  });
  seen.resize(std::min(seen.size(), kMostCarriers));
  return seen;
}

/// Those that explain more than their neighbours, the best first.
std::vector<Hypothesis> peaks(const std::vector<Hypothesis>& along) {
  std::vector<Hypothesis> found;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double score = along[i].score;
    const bool is_peak = score > 0.0 && (i == 0 || along[i - 1].score <= score) &&
                         (i + 1 == along.size() || along[i + 1].score < score);
    if (is_peak) found.push_back(along[i]);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.score > b.score; });
  found.resize(std::min(found.size(), kMostPeaks));
  return found;
}

}  // namespace

std::vector<Hypothesis> with_base_swung(SearchImage& image, const SoughtModel& sought,
                                        const Configuration& held, const Configuration& answer,
                                        const std::vector<Agreement>& bodies,
                                        const Executor& executor) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(sought.model.tree, answer, poses);
  const Hypothesis known{answer, sought.all_bodies};
  std::vector<Hypothesis> swung;
  for (const std::size_t body : carriers(bodies)) {
    std::vector<Hypothesis> along = with_body_at(sought, held, body, poses[body], kSwingSteps);
    executor.for_each(along.size(), [&](std::size_t i) {
      along[i].score = image.score(along[i], kSwingSlack, kSwingTolerance, true);
    });
    for (Hypothesis& peak : peaks(along)) {
      const Eigen::Isometry3d& base = peak.configuration.T_camera_base;
      if (!are_apart(sought.extent, peak, known) || has_base(sought.extent, swung, base)) continue;
      swung.push_back(std::move(peak));
    }
  }
  return swung;
}

}  // namespace lockbox
