// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/classification.hpp"

#include <algorithm>

namespace lockbox {

std::string to_string(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::initializing:
      return "initializing";
    case TrackingStatus::tracking:
      return "tracking";
    case TrackingStatus::uncertain:
      return "uncertain";
    case TrackingStatus::lost:
      return "lost";
  }
  return "lost";
}

bool is_contradicted(const Agreement& body, const TrackerOptions& options) {
  const double decided = body.explained + body.contradicted;
  const bool lies_in_front = body.groups_behind > options.most_groups_behind * decided &&
                             body.groups_behind * body.pixels > options.least_body_pixels;
  const bool violates_free_space = body.precision() < options.least_body_agreement &&
                                   decided * body.pixels >= options.least_body_pixels;
  return lies_in_front || violates_free_space;
}

std::vector<int> contradicted_bodies(const RegistrationResult& registered,
                                     const TrackerOptions& options) {
  const Agreement& whole = registered.agreement;
  const bool is_whole =
      whole.explained >= options.least_explained && whole.precision() >= options.least_agreement;
  std::vector<int> bodies;
  if (!is_whole) bodies.push_back(0);
  for (std::size_t b = is_whole ? 0 : 1; b < registered.body_agreement.size(); ++b) {
    if (is_contradicted(registered.body_agreement[b], options))
      bodies.push_back(static_cast<int>(b));
  }
  return bodies;
}

std::vector<int> contradicted_variables(const RegistrationResult& registered,
                                        const KinematicTree& tree, const TrackerOptions& options) {
  std::vector<int> variables;
  for (const int body : contradicted_bodies(registered, options)) {
    const int joint = tree.bodies[static_cast<std::size_t>(body)].parent_joint;
    if (joint < 0) continue;
    const int variable = tree.joints[static_cast<std::size_t>(joint)].variable;
    if (!options.registration.is_locked(variable)) variables.push_back(variable);
  }
  return variables;
}

bool is_doubtful(const RegistrationResult& registered, int variable, const JointMargins& margins,
                 const KinematicTree& tree, const TrackerOptions& options) {
  const auto v = static_cast<std::size_t>(variable);
  if (v >= margins.size()) return false;
  if (margins[v] == kNotTold) return true;
  const auto joint = static_cast<std::size_t>(tree.variable_joint[v]);
  const auto body = static_cast<std::size_t>(tree.joints[joint].child_body);
  const bool is_hidden = registered.body_agreement[body].explained < options.least_of_sought_body;
  return is_hidden && margins[v] < options.least_margin_of_hidden;
}

std::vector<bool> known_unknowns(const RegistrationResult& registered, const KinematicTree& tree,
                                 const TrackerOptions& options) {
  std::vector<bool> known = registered.observable;
  for (int v = 0; v < tree.variables(); ++v) {
    const int joint = tree.variable_joint[static_cast<std::size_t>(v)];
    const bool slides = tree.joints[static_cast<std::size_t>(joint)].type == JointType::prismatic;
    const double most = slides ? options.most_sliding_sigma : options.most_turning_sigma;
    if (!(registered.sigma[unknown_of(v)] <= most))
      known[static_cast<std::size_t>(unknown_of(v))] = false;
  }
  for (const int v : contradicted_variables(registered, tree, options)) {
    known[static_cast<std::size_t>(unknown_of(v))] = false;
  }
  return known;
}

double score(const RegistrationResult& registered, const TrackerOptions& options) {
  Agreement agreement = registered.agreement;
  if (registered.contour.continued() > options.most_continued) agreement.explained = 0.0;
  return agreement.score();
}

bool is_believed(const Answer& answer, const TrackerOptions& options) {
  return answer.belief >= options.convincing_belief &&
         answer.agreement.explained >= options.least_explained;
}

bool agrees(const Answer& answer, const TrackerOptions& options) {
  return is_believed(answer, options) || contradicted_bodies(answer, options).empty();
}

bool rests(const RegistrationResult& registered, const TrackerOptions& options) {
  return registered.last_move <= options.most_last_move;
}

bool is_believable(const Answer& answer, const TrackerOptions& options) {
  return is_believed(answer, options) || (contradicted_bodies(answer, options).empty() &&
                                          answer.contour.continued() <= options.most_continued);
}

TrackingStatus classify(const Answer& answer, const TrackerOptions& options) {
  const Agreement& whole = answer.agreement;
  // Half: see TrackerOptions::least_explained.
  if (whole.explained < 0.5 * options.least_explained ||
      whole.precision() < options.lost_agreement) {
    return TrackingStatus::lost;
  }
  const bool is_known = answer.sigma.head<3>().norm() <= options.most_base_sigma &&
                        answer.rival_distance <= options.most_rival_distance;
  return rests(answer, options) && is_known && is_believable(answer, options)
             ? TrackingStatus::tracking
             : TrackingStatus::uncertain;
}

bool needs_no_search(const Answer& answer, bool is_kept, const TrackerOptions& options) {
  return classify(answer, options) == TrackingStatus::tracking ||
         (is_kept && agrees(answer, options) && rests(answer, options));
}

}  // namespace lockbox
