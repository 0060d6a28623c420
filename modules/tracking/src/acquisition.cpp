// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/acquisition.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "alternatives.hpp"
#include "lockbox/cloud/segmentation.hpp"
#include "lockbox/model/forward_kinematics.hpp"
#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

/// Of a search, as a short one takes on the README's machine where nothing is found; the longest
/// take four times as long. Doubled, a limit is half as many rounds.
constexpr double kSecondsOfRound = 1.5;

/// Searches beside live frames that find nothing, before other readings of a frame are tried: a
/// camera may not be aimed yet, and the search that finds the object must not wait for them.
/// Source: two take some three to twenty seconds. Doubled, who has mirrored images is told twice as
/// late.
constexpr int kFailuresWhileAiming = 2;

int rounds_a_frame(const TrackerOptions& options) {
  constexpr double kMost = 1000.0;  // more than there are
  return std::max(1, static_cast<int>(std::min(kMost, options.search_limit / kSecondsOfRound)));
}

}  // namespace

bool keep_better(const Answer& answer, const TrackerOptions& options, Answer& best) {
  const bool is_better = score(answer, options) > score(best, options);
  if (is_better) best = answer;
  return is_better;
}

void doubt_base(double rival_distance, Answer& answer) {
  answer.rival_distance = rival_distance;
  answer.covariance.diagonal().head<3>().array() += rival_distance * rival_distance;
  answer.sigma.head<3>() = answer.covariance.diagonal().head<3>().cwiseSqrt();
}

void keep_doubts(const Answer& answer, Answer& followed) {
  doubt_base(answer.rival_distance, followed);
  std::transform(answer.observable.begin(), answer.observable.end(), followed.observable.begin(),
                 followed.observable.begin(), std::logical_and<>());
}

Acquisition::Acquisition(const ArticulatedModel& model, const TrackerOptions& options,
                         const Executor& executor, ArticulatedRegistration& registration,
                         const TiledCloud& cloud)
    : model_(model),
      options_(options),
      executor_(executor),
      registration_(registration),
      cloud_(cloud),
      look_alikes_(std::make_shared<const LookAlikes>(model, options.registration.locked)) {}

std::optional<Answer> Acquisition::find(const DepthFrame& frame,
                                        const std::optional<Configuration>& guess,
                                        SearchScope scope) {
  best_.reset();
  if (guess && scope != SearchScope::anywhere && find_from(*guess, scope)) {
    return best_;
  }
  if (scope != SearchScope::near) {
    ++searches_;
    look_anywhere(guess);
    if (is_found() && is_rather_misread(frame)) {
      best_.reset();
      alternatives_.clear();
    } else if (is_found()) {
      failure_.reset();
    } else if (progress_.rounds == 0) {  // else it goes on
      failure_ = explain(frame);
    }
  }
  return best_;
}

void Acquisition::look_anywhere(const std::optional<Configuration>& guess) {
  alternatives_.clear();
  const std::vector<Candidate> candidates =
      initializer().find_part(cloud_, guess, rounds_a_frame(options_), progress_);
  // What is believed less is not what the most convincing one is mistaken for.
  const double least_belief =
      candidates.empty() ? 0.0 : (1.0 - options_.convincing_belief) * candidates.front().belief;
  std::optional<Answer> likeliest;
  for (const Candidate& candidate : candidates) {
    if (candidate.evidence < least_evidence(options_.evidence) || candidate.belief < least_belief)
      break;
    const Answer found = registered(candidate, narrow());
    if (ends_search(candidate, found)) {
      doubt_if_rivalled(candidate, candidates);
      return;
    }
    if (!likeliest) likeliest = found;
  }
  // None is sure: that for which the image speaks most.
  if (!likeliest || classify(*likeliest, options_) == TrackingStatus::lost) return;
  best_ = likeliest;
  doubt_if_rivalled(candidates.front(), candidates);
}

Answer Acquisition::registered(const Candidate& candidate, const AlignOptions& how) {
  Answer found = registration_.align(cloud_, candidate.configuration, how);
  // What has gone elsewhere was not asked for: its belief is not known.
  const bool is_there = registration_.moves().between(candidate.configuration, found.at_rest) <=
                        options_.most_rival_distance;
  found.belief = is_there ? candidate.belief : 0.0;
  doubt_joints(candidate.margins, found);
  return found;
}

/// What the search could not tell from it may be right as well.
void Acquisition::doubt_if_rivalled(const Candidate& answer,
                                    const std::vector<Candidate>& candidates) {
  if (answer.rival_distance <= options_.most_rival_distance) return;
  doubt_base(answer.rival_distance, *best_);
  alternatives_ = alternatives_to(answer, candidates, options_, registration_.moves());
}

bool Acquisition::is_found() const {
  return best_ && classify(*best_, options_) == TrackingStatus::tracking;
}

/// Other readings are tried once. What they have told holds until something is found.
SearchFailure Acquisition::explain(const DepthFrame& frame) {
  const RegistrationResult* const best = best_ ? &*best_ : nullptr;
  SearchFailure failure = search_failure(frame, model_.tree, options_, best);
  if (best_) failure.look_alikes = look_alikes().of(best_->configuration).size();
  if (failure_) {
    failure.is_mirrored = failure_->is_mirrored;
    failure.depth_factor = failure_->depth_factor;
  }
  if (failure.look_alikes > 0) return failure;
  if (!options_.background_search || ++failures_ >= kFailuresWhileAiming) {
    try_once_otherwise(frame, failure);
  }
  return failure;
}

void Acquisition::try_once_otherwise(const DepthFrame& frame, SearchFailure& failure) {
  const bool was_tried = std::exchange(was_read_otherwise_, true);
  if (was_tried || !options_.try_other_readings || is_explained(failure)) return;
  try_other_readings(frame, model_, options_, executor_, best_ ? &*best_ : nullptr, failure);
}

/// A mirrored image may show enough of a model for a wrong answer that is convincing as a whole,
/// though not in all of its parts. Live frames do not wait for that: there the camera's driver says
/// whether it mirrors.
bool Acquisition::is_rather_misread(const DepthFrame& frame) {
  if (contradicted_bodies(*best_, options_).empty()) return false;
  if (!was_read_otherwise_ && !options_.background_search) {
    SearchFailure failure = search_failure(frame, model_.tree, options_, &*best_);
    try_once_otherwise(frame, failure);
    failure_ = failure;
  }
  return failure_ && (failure_->is_mirrored || failure_->depth_factor != 1.0);
}

/// Wrong answers drift off when gates open. Right ones may, too, along the table they stand on;
/// then iterations within narrow gates, few as in any frame, keep them where the search has put
/// them.
bool Acquisition::ends_search(const Candidate& candidate, const Answer& found) {
  const bool stays = found.belief > 0.0 && consider(found);
  if (!stays && candidate.belief < options_.convincing_belief) return false;
  // An answer before it may explain more, while something contradicts that: then neither is sure.
  if (stays && classify(*best_, options_) != TrackingStatus::tracking) return true;
  const Answer kept = registered(candidate, {0.0, options_.registration.max_iterations});
  const bool is_kept = classify(kept, options_) == TrackingStatus::tracking;
  if (is_kept) best_ = kept;
  return stays || is_kept;
}

void Acquisition::doubt_joints(const JointMargins& margins, Answer& answer) const {
  for (int v = 0; v < model_.tree.variables(); ++v) {
    if (is_doubtful(answer, v, margins, model_.tree, options_)) {
      answer.observable[static_cast<std::size_t>(unknown_of(v))] = false;
    }
  }
}

bool Acquisition::find_from(const Configuration& guess, SearchScope scope) {
  if (is_enough(registration_.align(cloud_, guess, narrow()), guess, scope)) return true;
  const bool is_on_its_way = best_->last_move > options_.most_last_move;
  if (is_on_its_way &&
      is_enough(registration_.align(cloud_, best_->at_rest, narrow()), guess, scope)) {
    return true;
  }
  const std::vector<int> dragged = dragged_variables(guess, *best_);
  if (!dragged.empty() && consider(with_joints_sought(best_->at_rest, dragged))) return true;
  if (is_enough(find_near(guess), guess, scope)) return true;
  // Frames that did not wait for a search went by, and joints may have moved anywhere in them.
  return options_.background_search &&
         consider(with_joints_sought(
             best_->at_rest, options_.registration.free_variables(model_.tree.variables())));
}

Answer Acquisition::with_joints_sought(const Configuration& start,
                                       const std::vector<int>& variables) {
  const SoughtJoints sought = find_joints(start, variables);
  Answer answer = registration_.align(cloud_, sought.configuration, narrow());
  doubt_joints(sought.margins, answer);
  return answer;
}

AlignOptions Acquisition::narrow() const {
  return {options_.start_joint_sigma, options_.start_joint_iterations};
}

/// Keeps it if it is the best so far; true if nothing else is to be sought.
bool Acquisition::is_enough(const Answer& found, const Configuration& guess, SearchScope scope) {
  if (consider(found)) return true;
  const bool is_where_given =
      scope == SearchScope::given_first &&
      registration_.moves().between(guess, found.at_rest) <= options_.start_sigma;
  if (!is_where_given || !agrees(found, options_) || !rests(found, options_)) return false;
  best_ = found;
  return true;
}

/// Keeps it if it is the best so far; true if it is classified `tracking`.
bool Acquisition::consider(const Answer& found) {
  if (!best_) best_ = found;
  keep_better(found, options_, *best_);
  return classify(found, options_) == TrackingStatus::tracking;
}

Answer Acquisition::find_near(const Configuration& guess) {
  find_object(guess);
  const Configuration placed =
      registration_.align(object_, guess, {options_.start_sigma, options_.start_iterations, true})
          .at_rest;
  return registration_.align(cloud_, placed, narrow());
}

/// Of an answer in which bodies contradict the image: theirs, and those that are elsewhere than in
/// the guess. On its way an alignment drags joints along, to where they rest, but do not belong.
std::vector<int> Acquisition::dragged_variables(const Configuration& guess,
                                                const Answer& answer) const {
  std::vector<int> dragged = contradicted_variables(answer, model_.tree, options_);
  if (dragged.empty()) return dragged;
  for (const int v : options_.registration.free_variables(model_.tree.variables())) {
    Configuration moved = guess;
    moved.q[v] = answer.at_rest.q[v];
    const bool is_apart =
        registration_.moves().between(guess, moved) > options_.most_rival_distance;
    if (is_apart && std::ranges::find(dragged, v) == dragged.end()) dragged.push_back(v);
  }
  return dragged;
}

/// Table, walls and clutter would pull at wide gates.
void Acquisition::find_object(const Configuration& start) {
  object_ = cloud_;
  BodyPoses poses;
  forward_kinematics(model_.tree, start, poses);
  std::vector<ExpectedBody> expected;
  for (std::size_t b = 0; b < model_.fields.size(); ++b) {
    if (model_.fields[b]) {
      expected.push_back({poses[b], model_.fields[b]->bounds()});
    }
  }
  SegmentationOptions segmentation;
  segmentation.depth_noise = options_.registration.noise.sigma_inverse_depth();
  const ObjectSegmenter segmenter(segmentation);
  if (const auto mask = segmenter.segment(cloud_, expected, options_.start_margin)) {
    object_.keep(*mask);
  }
}

SoughtJoints Acquisition::find_joints(const Configuration& start,
                                      const std::vector<int>& variables) {
  return initializer().find_joints(cloud_, start, variables);
}

void Acquisition::assume(const RegistrationOptions& registration) {
  options_.registration = registration;
  initializer_.reset();
  if (options_.background_search) prepare();  // as at the start
}

Initializer& Acquisition::initializer() {
  if (!initializer_) {
    InitializerOptions options{options_.registration, options_.evidence};
    options.registration.fixed_base = false;  // it is held where it was found
    options.stop_request = options_.stop_request;
    initializer_.emplace(model_, options, executor_, look_alikes_);
  }
  return *initializer_;
}

}  // namespace lockbox
