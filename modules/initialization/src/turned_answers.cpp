// SPDX-License-Identifier: BSD-3-Clause
// What else the object may be that was taken for an answer (docs/verification.md, "Belief").
#include <algorithm>
#include <numeric>

#include "lockbox/model/forward_kinematics.hpp"
#include "search_workspace.hpp"

namespace lockbox {
namespace {

constexpr Breadth kAll{1, kEachTurn, kEachTurn, kEachTurn, std::nullopt, 4, false};
/// Bodies of which more is seen than of the base. Doubled, doors that are the third largest thing
/// in view are tried, too.
constexpr std::size_t kMostCarriers = 2;

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
  for (const std::size_t body : bodies_before_the_base(bodies)) {
    add_matched(body, poses[body], hypotheses);
  }
}

}  // namespace lockbox
