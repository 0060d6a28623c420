// SPDX-License-Identifier: BSD-3-Clause
// What else the object may be that was taken for an answer (docs/verification.md, "Belief").
#include <algorithm>
#include <numeric>

#include "lockbox/model/forward_kinematics.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr Breadth kAll{1, kEachTurn, kEachTurn, kEachTurn, std::nullopt, 4, false};
/// Bodies of which more is seen than of the base. Source: as many as a chest of drawers has fronts.
/// Doubled, the turns of a wall of doors take twice as long.
constexpr std::size_t kMostCarriers = 8;
/// Bases that are nearer to each other are tried once: fronts in one plane say the same. Unit:
/// metres, and radians. Source: half of what makes two answers. Doubled, a base that is 2 cm off is
/// not tried.
constexpr double kSameBase = 0.01;

bool is_same_base(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d between = a.inverse() * b;
  return between.translation().norm() < kSameBase &&
         Eigen::AngleAxisd(between.linear()).angle() < kSameBase;
}

double explained_pixels(const Agreement& body) {
  return body.explained * body.pixels;
}

/// The bodies of which more is explained than of the base, the most first.
std::vector<std::size_t> bodies_before_the_base(const std::vector<Agreement>& bodies) {
  std::vector<std::size_t> before(bodies.size());
  std::iota(before.begin(), before.end(), std::size_t{0});
  std::erase_if(before, [&](std::size_t body) {
    return explained_pixels(bodies[body]) <= explained_pixels(bodies.front());
  });
  std::stable_sort(before.begin(), before.end(), [&](std::size_t a, std::size_t b) {
    return explained_pixels(bodies[a]) > explained_pixels(bodies[b]);
  });
  before.resize(std::min(before.size(), kMostCarriers));
  return before;
}

}  // namespace

std::vector<Hypothesis> Initializer::Workspace::seek_turned(const TiledCloud& cloud,
                                                            const Candidate& found) {
  const Configuration& configuration = found.configuration;
  std::vector<Hypothesis> hypotheses;
  for (const Eigen::Isometry3d& turn : turns) {
    hypotheses.push_back({held, all_bodies});
    hypotheses.back().configuration.T_camera_base = configuration.T_camera_base * turn;
  }
  add_swung(cloud, configuration, hypotheses);
  return followed(cloud, std::move(hypotheses), kAll, found.evidence);
}

/// What is seen of it may be a door for the most part, and stand where the door does with its hinge
/// at any angle: all that tells is how little there is of a carcass.
void Initializer::Workspace::add_swung(const TiledCloud& cloud, const Configuration& found,
                                       std::vector<Hypothesis>& hypotheses) {
  const std::vector<Agreement> bodies = align_finely(cloud, found, {0.0, 0}).body_agreement;
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(model.tree, found, poses);
  std::vector<Hypothesis> swung;
  for (const std::size_t body : bodies_before_the_base(bodies)) {
    add_matched(body, poses[body], swung);
  }
  const std::size_t first = hypotheses.size();
  for (Hypothesis& hypothesis : swung) {
    const bool is_known = std::any_of(hypotheses.begin() + static_cast<std::ptrdiff_t>(first),
                                      hypotheses.end(), [&](const Hypothesis& other) {
                                        return is_same_base(hypothesis.configuration.T_camera_base,
                                                            other.configuration.T_camera_base);
                                      });
    if (!is_known) hypotheses.push_back(std::move(hypothesis));
  }
}

}  // namespace lockbox
