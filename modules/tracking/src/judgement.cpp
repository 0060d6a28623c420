// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/judgement.hpp"

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
  const bool lies_in_front = body.patches_behind > options.most_patches_behind * decided &&
                             body.patches_behind * body.pixels > options.least_body_pixels;
  const bool is_seen_through = body.consent() < options.least_body_agreement &&
                               decided * body.pixels >= options.least_body_pixels;
  return lies_in_front || is_seen_through;
}

std::vector<int> contradicted_bodies(const RegistrationResult& registered,
                                     const TrackerOptions& options) {
  const Agreement& whole = registered.agreement;
  const bool is_whole =
      whole.explained >= options.least_explained && whole.consent() >= options.least_agreement;
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
    if (!(registered.sigma[6 + v] <= most)) known[static_cast<std::size_t>(6 + v)] = false;
  }
  for (const int v : contradicted_variables(registered, tree, options)) {
    known[static_cast<std::size_t>(6 + v)] = false;
  }
  return known;
}

double conviction(const RegistrationResult& registered, const TrackerOptions& options) {
  Agreement agreement = registered.agreement;
  if (registered.outline.continued() > options.most_continued) agreement.explained = 0.0;
  return agreement.conviction();
}

bool is_believed(const RegistrationResult& registered, const TrackerOptions& options) {
  return registered.belief >= options.convincing_belief;
}

bool agrees(const RegistrationResult& registered, const TrackerOptions& options) {
  return is_believed(registered, options) || contradicted_bodies(registered, options).empty();
}

bool rests(const RegistrationResult& registered, const TrackerOptions& options) {
  return registered.last_move <= options.most_last_move;
}

bool is_believable(const RegistrationResult& registered, const TrackerOptions& options) {
  return is_believed(registered, options) ||
         (contradicted_bodies(registered, options).empty() &&
          registered.outline.continued() <= options.most_continued);
}

TrackingStatus judge(const RegistrationResult& registered, const TrackerOptions& options) {
  const Agreement& whole = registered.agreement;
  // Half: see TrackerOptions::least_explained.
  if (whole.explained < 0.5 * options.least_explained || whole.consent() < options.lost_agreement) {
    return TrackingStatus::lost;
  }
  const bool is_known = registered.sigma.head<3>().norm() <= options.most_base_sigma &&
                        registered.rival_distance <= options.most_rival_distance;
  return rests(registered, options) && is_known && is_believable(registered, options)
             ? TrackingStatus::tracking
             : TrackingStatus::uncertain;
}

}  // namespace lockbox
