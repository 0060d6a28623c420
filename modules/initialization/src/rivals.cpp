// SPDX-License-Identifier: BSD-3-Clause
#include "rivals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "hypothesis.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

/// What is contradicted so much is no more probable than none, unless more is left than a box can
/// show: something like it stands there.
double credible_evidence(const EvidenceOptions& options, const Candidate& candidate) {
  const bool is_credible = candidate.contradiction <= options.most_contradicted ||
                           candidate.evidence >= evidence_beyond_a_box(options);
  return is_credible ? candidate.evidence : std::min(candidate.evidence, least_evidence(options));
}

/// Whether a base that is round is turned about its axis, and all that it carries is where it was.
bool is_turn_of_round_base(const SoughtModel& sought, const Configuration& a,
                           const Configuration& b) {
  const ArticulatedModel& model = sought.model;
  if (model.round_axes.empty()) return false;
  const double least = least_apart(sought.extent);
  const Eigen::AlignedBox3d base = bounds(model.tree.bodies.front().mesh);
  const Eigen::Vector3d middle = base.isEmpty() ? Eigen::Vector3d(0.0, 0.0, 0.0) : base.center();
  const Eigen::Isometry3d turn = a.T_camera_base.inverse() * b.T_camera_base;
  const auto stays = [&](const Eigen::Vector3d& p) { return (turn * p - p).norm() < least; };
  // A ball is turned about any axis.
  const bool is_turned =
      stays(middle) && (model.round_axes.size() > 1 ||
                        stays(middle + base.diagonal().norm() * model.round_axes.front()));
  if (!is_turned) return false;
  BodyPoses poses_a;
  BodyPoses poses_b;
  forward_kinematics(model.tree, a, poses_a);
  forward_kinematics(model.tree, b, poses_b);
  for (std::size_t body = 1; body < poses_a.size(); ++body) {
    const Eigen::AlignedBox3d box = bounds(model.tree.bodies[body].mesh);
    if (farthest_corner(box, poses_a[body], poses_b[body]) >= least) return false;
  }
  return true;
}

}  // namespace

double farthest_move(const ModelExtent& extent, std::span<const Eigen::Isometry3d> symmetries,
                     const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::AlignedBox3d box(extent.centre - 0.5 * extent.sides,
                                extent.centre + 0.5 * extent.sides);
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Isometry3d& symmetry : symmetries) {
    const Eigen::Isometry3d move = to.inverse() * from * symmetry;
    least = std::min(least, farthest_corner(box, Eigen::Isometry3d::Identity(), move));
  }
  return least;
}

bool are_one(const SoughtModel& sought, const Configuration& a, const Configuration& b) {
  const double move =
      farthest_move(sought.extent, sought.symmetries, a.T_camera_base, b.T_camera_base);
  return move < least_apart(sought.extent) || is_turn_of_round_base(sought, a, b);
}

void sort_best_first(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
}

void compare(const SoughtModel& sought, std::vector<Candidate>& candidates) {
  // Of those that are one, however often it was found, the best counts.
  std::vector<const Candidate*> apart;
  for (const Candidate& candidate : candidates) {
    const bool is_known = std::any_of(apart.begin(), apart.end(), [&](const Candidate* better) {
      return are_one(sought, better->configuration, candidate.configuration);
    });
    if (!is_known) apart.push_back(&candidate);
  }
  std::vector<double> others;
  for (Candidate& candidate : candidates) {
    const Configuration& here = candidate.configuration;
    others.clear();
    const double evidence = credible_evidence(sought.evidence, candidate);
    // What is not in view may be as far away as what is.
    double squares =
        std::exp(log_odds(least_evidence(sought.evidence), evidence, sought.evidence)) *
        here.T_camera_base.translation().squaredNorm();
    for (const Candidate* other : apart) {
      if (are_one(sought, here, other->configuration)) continue;
      const double move = farthest_move(sought.extent, sought.symmetries, here.T_camera_base,
                                        other->configuration.T_camera_base);
      others.push_back(other->evidence);
      squares += std::exp(log_odds(other->evidence, evidence, sought.evidence)) * move * move;
    }
    candidate.belief = belief(evidence, others, sought.evidence);
    candidate.rival_distance = std::sqrt(candidate.belief * squares);
    const Configuration& first = candidates.front().configuration;
    candidate.distance = are_one(sought, first, here)
                             ? 0.0
                             : farthest_move(sought.extent, sought.symmetries, first.T_camera_base,
                                             here.T_camera_base);
    candidate.is_in_place_of_first = place_distance(sought.extent, first, here) < 1.0;
  }
}

void keep_most_apart(const SoughtModel& sought, std::size_t most,
                     std::vector<Candidate>& candidates) {
  std::vector<Configuration> apart;
  std::vector<std::uint8_t> has_second;
  std::erase_if(candidates, [&](const Candidate& candidate) {
    const auto first = std::find_if(apart.begin(), apart.end(), [&](const Configuration& other) {
      return are_one(sought, other, candidate.configuration);
    });
    if (first != apart.end())
      return std::exchange(has_second[static_cast<std::size_t>(first - apart.begin())], 1) != 0;
    if (apart.size() == most) return true;
    apart.push_back(candidate.configuration);
    has_second.push_back(0);
    return false;
  });
}

double belief_in_place_of_first(const SoughtModel& sought, const std::vector<Candidate>& compared) {
  if (compared.empty()) return 0.0;
  std::vector<double> elsewhere;
  for (const Candidate& candidate : compared) {
    if (!candidate.is_in_place_of_first) elsewhere.push_back(candidate.evidence);
  }
  return belief(credible_evidence(sought.evidence, compared.front()), elsewhere, sought.evidence);
}

}  // namespace lockbox
