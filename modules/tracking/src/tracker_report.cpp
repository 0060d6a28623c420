// SPDX-License-Identifier: BSD-3-Clause
// What the tracker tells of a frame: the estimate, its status, how probable it is.
#include <algorithm>

#include "lockbox/verification/belief.hpp"
#include "tracker_loop.hpp"

namespace lockbox {

double Tracker::Loop::belief_by_image(const Configuration& configuration) {
  verifier_.look_at(cloud_, options_.registration.noise.sigma_inverse_depth(), executor_);
  return belief(verifier_.evidence(configuration).total(), {});
}

/// In view, and still not determined, because what is around it goes on in its surface.
bool Tracker::Loop::is_flush(const Answer& found, int variable) const {
  const int joint = model_.tree.variable_joint[static_cast<std::size_t>(variable)];
  const auto body =
      static_cast<std::size_t>(model_.tree.joints[static_cast<std::size_t>(joint)].child_body);
  return !found.observable[static_cast<std::size_t>(6 + variable)] &&
         body < found.flush_bodies.size() && found.flush_bodies[body] &&
         found.body_agreement[body].explained >= options_.least_of_sought_body;
}

void Tracker::Loop::report(const Answer& registered) {
  for (int v = 0; v < model_.tree.variables(); ++v) {
    is_flush_[static_cast<std::size_t>(v)] = is_flush(registered, v);
  }
  result_.configuration = registered.configuration;
  result_.covariance = registered.covariance;
  result_.sigma = registered.sigma;
  result_.observable = known_unknowns(registered, model_.tree, options_);
  result_.residual_rms = registered.residual_rms;
  result_.explained = registered.agreement.explained;
  result_.contradicted = registered.agreement.contradicted;
  result_.occluded = registered.agreement.occluded;
  const TrackingStatus before = status_;
  status_ = classify(registered, options_);
  belief_ = registered.belief;
  doubted_.clear();
  if (status_ == TrackingStatus::tracking) {
    doubted_ = contradicted_bodies(registered, options_);
  }
  rival_distance_ = registered.rival_distance;
  base_turning_sigma_ = registered.base_turning_sigma;
  report_belief(registered, before);
}

/// Following tells nothing of what a search could not tell apart: then its belief stays. What was
/// believed once, and is tracked since, is not believed less because more of it is hidden, only
/// where the image speaks against it.
void Tracker::Loop::report_belief(const Answer& registered, TrackingStatus before) {
  if (status_ == TrackingStatus::lost) {
    result_.belief = 0.0;
    result_.alternatives.clear();
    return;
  }
  const bool is_doubted = registered.rival_distance > 0.0;
  const bool is_due =
      status_ != before || ++frames_without_belief_ >= options_.frames_between_beliefs;
  double asked = registered.belief;
  if (!(asked > 0.0) && !is_doubted && is_due) asked = belief_by_image(registered.configuration);
  if (asked > 0.0) {
    const bool is_followed =
        before == TrackingStatus::tracking && status_ == TrackingStatus::tracking;
    const bool is_against = asked < belief(0.0, {});
    result_.belief = is_followed && !is_against ? std::max(asked, result_.belief) : asked;
    frames_without_belief_ = 0;
  }
  result_.alternatives.clear();
  if (is_doubted) {
    result_.alternatives = background_ ? background_->alternatives() : acquisition_.alternatives();
  }
}

/// What disagrees in size, or is too small to tell how it is turned, is followed as well as ever,
/// but not to be trusted.
void Tracker::Loop::report_status() {
  result_.size = size_record_.mean();
  const bool is_trusted =
      base_turning_sigma_ <= options_.most_base_turning_sigma && !result_.size.is_implausible();
  const bool is_tracking = status_ == TrackingStatus::tracking;
  result_.status = is_tracking && !is_trusted ? TrackingStatus::uncertain : status_;
}

void Tracker::Loop::report_nothing() {
  result_.belief = 0.0;
  result_.alternatives.clear();
  result_.residual_rms = TrackingResult::kNothingFound;
  result_.explained = TrackingResult::kNothingFound;
  result_.contradicted = TrackingResult::kNothingFound;
  result_.occluded = TrackingResult::kNothingFound;
}

/// What was never sure is not lost: it is sought as at the start.
void Tracker::Loop::forget() {
  status_ = TrackingStatus::initializing;
  result_.configuration = unknown_configuration(model_.tree);
  std::fill(result_.observable.begin(), result_.observable.end(), false);
  result_.covariance.resize(0, 0);
  result_.sigma.resize(0);
  report_nothing();
}

}  // namespace lockbox
