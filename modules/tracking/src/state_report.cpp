// SPDX-License-Identifier: BSD-3-Clause
#include "state_report.hpp"

#include <algorithm>
#include <cstddef>

#include "lockbox/verification/belief.hpp"

namespace lockbox {

StateReport::StateReport(const KinematicTree& tree, const TrackerOptions& options,
                         ImageBelief& image_belief)
    : tree_(tree), options_(options), image_belief_(image_belief) {
  result_.configuration = unknown_configuration(tree);
}

void StateReport::begin(double stamp, Elapsed cloud_time) {
  result_.stamp = stamp;
  result_.cloud_time = cloud_time;
}

void StateReport::write(const Answer& answer, const Verdict& before, const Verdict& now,
                        const std::vector<Alternative>& alternatives) {
  result_.configuration = answer.configuration;
  result_.covariance = answer.covariance;
  result_.sigma = answer.sigma;
  result_.observable = known_unknowns(answer, tree_, options_);
  result_.residual_rms = answer.residual_rms;
  result_.explained = answer.agreement.explained;
  result_.contradicted = answer.agreement.contradicted;
  result_.occluded = answer.agreement.occluded;
  write_belief(answer, before, now, alternatives);
}

/// Following tells nothing of what a search could not tell apart: then its belief stays. What was
/// believed once, and is tracked since, is not believed less because more of it is hidden, only
/// where the image speaks against it.
void StateReport::write_belief(const Answer& answer, const Verdict& before, const Verdict& now,
                               const std::vector<Alternative>& alternatives) {
  if (now.status == TrackingStatus::lost) {
    result_.belief = 0.0;
    result_.alternatives.clear();
    return;
  }
  const bool is_doubted = answer.rival_distance > 0.0;
  const bool is_due =
      now.status != before.status || ++frames_without_belief_ >= options_.frames_between_beliefs;
  double asked = answer.belief;
  if (!(asked > 0.0) && !is_doubted && is_due) asked = image_belief_.of(answer.configuration);
  if (asked > 0.0) {
    const bool is_followed =
        before.status == TrackingStatus::tracking && now.status == TrackingStatus::tracking;
    const bool is_against = asked < belief(0.0, {}, options_.evidence);
    result_.belief = is_followed && !is_against ? std::max(asked, result_.belief) : asked;
    frames_without_belief_ = 0;
  }
  result_.alternatives.clear();
  if (is_doubted) result_.alternatives = alternatives;
}

void StateReport::withhold_unknown(const JointSight& sight) {
  for (int v = 0; v < tree_.variables(); ++v) {
    if (!sight.is_known(v)) result_.observable[static_cast<std::size_t>(unknown_of(v))] = false;
  }
}

void StateReport::write_nothing() {
  result_.belief = 0.0;
  result_.alternatives.clear();
  result_.residual_rms = TrackingResult::kNothingFound;
  result_.explained = TrackingResult::kNothingFound;
  result_.contradicted = TrackingResult::kNothingFound;
  result_.occluded = TrackingResult::kNothingFound;
}

void StateReport::forget() {
  result_.configuration = unknown_configuration(tree_);
  std::fill(result_.observable.begin(), result_.observable.end(), false);
  result_.covariance.resize(0, 0);
  result_.sigma.resize(0);
  write_nothing();
}

/// What disagrees in size, or is too small to tell how it is turned, is followed as well as ever,
/// but not to be trusted.
void StateReport::end(const Verdict& verdict, const ApparentSize& size, int searches,
                      Elapsed step_time) {
  result_.size = size;
  result_.searches = searches;
  const bool is_trusted = verdict.base_turning_sigma <= options_.most_base_turning_sigma &&
                          !result_.size.is_implausible();
  const bool is_tracking = verdict.status == TrackingStatus::tracking;
  result_.status = is_tracking && !is_trusted ? TrackingStatus::uncertain : verdict.status;
  result_.step_time = step_time;
  result_.latency_ms = result_.cloud_time.wall_ms + result_.step_time.wall_ms;
}

void StateReport::repeat(double stamp) {
  result_.stamp = stamp;
  result_.cloud_time = {};
  result_.step_time = {};
  result_.latency_ms = 0.0;
}

}  // namespace lockbox
