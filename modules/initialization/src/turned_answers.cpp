// SPDX-License-Identifier: BSD-3-Clause
#include "turned_answers.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "mistaken_bases.hpp"
#include "twin_bodies.hpp"

namespace lockbox {
namespace {

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
                                       const Configuration& answer) {
  std::vector<Hypothesis> hypotheses = turned(sought, held, answer, sought.turns);
  for (std::vector<Hypothesis> others :
       {moved_along_twins(sought, held, answer), with_base_mistaken(sought, held, answer)}) {
    std::move(others.begin(), others.end(), std::back_inserter(hypotheses));
  }
  return hypotheses;
}

std::vector<Hypothesis> turned_about_round(const SoughtModel& sought, const Configuration& held,
                                           const Configuration& answer) {
  return turned(sought, held, answer, sought.round_turns);
}

}  // namespace lockbox
