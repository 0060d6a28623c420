// SPDX-License-Identifier: BSD-3-Clause
#include "turned_answers.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "lockbox/model/forward_kinematics.hpp"
#include "mistaken_bases.hpp"
#include "twin_bodies.hpp"

namespace lockbox {
namespace {

/// Bodies of which more is seen than of the base. Source: as many as a chest of drawers has fronts.
/// Doubled, the turns of a wall of doors take twice as long.
constexpr std::size_t kMostCarriers = 8;
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

/// What is seen of it may be a door for the most part, and stand where the door does with its hinge
/// at any angle: all that tells is how little there is of a carcass.
std::vector<Hypothesis> swung(const SoughtModel& sought, const Configuration& held,
                              const Configuration& answer, const std::vector<Agreement>& bodies) {
  std::vector<Eigen::Isometry3d> poses;
  forward_kinematics(sought.model.tree, answer, poses);
  std::vector<Hypothesis> all;
  for (const std::size_t body : bodies_before_the_base(bodies)) {
    for (Hypothesis& there : with_body_at(sought, held, body, poses[body])) {
      if (!has_base(sought.extent, all, there.configuration.T_camera_base))
        all.push_back(std::move(there));
    }
  }
  return all;
}

std::vector<Hypothesis> turned(const SoughtModel& sought, const Configuration& held,
                               const Configuration& answer,
                               const std::vector<Eigen::Isometry3d>& turns) {
  std::vector<Hypothesis> hypotheses;
  for (const Eigen::Isometry3d& turn : turns) {
    hypotheses.push_back({held, sought.all_bodies});
    hypotheses.back().configuration.T_camera_base = answer.T_camera_base * turn;
  }
  return hypotheses;
}

}  // namespace

std::vector<Hypothesis> turned_answers(const SoughtModel& sought, const Configuration& held,
                                       const Configuration& answer,
                                       const std::vector<Agreement>& bodies) {
  std::vector<Hypothesis> hypotheses = turned(sought, held, answer, sought.turns);
  for (std::vector<Hypothesis> others :
       {swung(sought, held, answer, bodies), moved_along_twins(sought, held, answer),
        with_base_mistaken(sought, held, answer)}) {
    std::move(others.begin(), others.end(), std::back_inserter(hypotheses));
  }
  return hypotheses;
}

std::vector<Hypothesis> turned_about_round(const SoughtModel& sought, const Configuration& held,
                                           const Configuration& answer) {
  return turned(sought, held, answer, sought.round_turns);
}

}  // namespace lockbox
