// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker.hpp"

namespace lockbox {
namespace {

constexpr int kFramesToKnowMotion = 2;    // a joint that comes back into sight is sought until then
constexpr int kLongestSearchPause = 8;    // frames
constexpr double kSuddenlyHidden = 0.15;  // of the visible surface, from one frame to the next
constexpr int kFramesOfDoubt = 4;         // until the object is sought anywhere

/// While nothing is found, the search of the whole frame pauses for longer and longer.
bool search_is_due(int frames_searched) {
  if (frames_searched < kLongestSearchPause) {
    return (frames_searched & (frames_searched - 1)) == 0;  // 0, 1, 2, 4
  }
  return frames_searched % kLongestSearchPause == 0;
}

}  // namespace

Tracker::Tracker(const ArticulatedModel& model, const TrackerOptions& options)
    : model_(model),
      options_(options),
      executor_(options.threads),
      registration_(model, options.registration, executor_),
      acquisition_(model, options, executor_, registration_, cloud_),
      predictor_(model.tree) {
  result_.configuration = unknown_configuration(model.tree);
  options_.registration.locked.resize(static_cast<std::size_t>(model.tree.variables()), false);
}

void Tracker::start(const Configuration& configuration) {
  guess_ = configuration;
  frames_searched_ = 0;
  result_.status = TrackingStatus::initializing;
}

bool Tracker::is_known() const {
  return result_.status == TrackingStatus::tracking || result_.status == TrackingStatus::uncertain;
}

const TrackingResult& Tracker::process(const DepthFrame& frame) {
  const Stopwatch cloud_watch;
  cloud_.assign(frame, options_.cloud, executor_);
  result_.cloud_time = cloud_watch.elapsed();
  const Stopwatch step_watch;
  result_.stamp = frame.stamp;
  if (is_known()) {
    follow(frame);
  } else {
    search(frame);
  }
  result_.step_time = step_watch.elapsed();
  result_.latency_ms = result_.cloud_time.wall_ms + result_.step_time.wall_ms;
  return result_;
}

void Tracker::search(const DepthFrame& frame) {
  const bool due = search_is_due(frames_searched_++);
  if (!due) {
    return;
  }
  const auto found = acquisition_.find(frame, guess_, options_.search_anywhere);
  result_.searches = acquisition_.searches();
  if (!found) {
    return;
  }
  const bool had_estimate = result_.status == TrackingStatus::lost || guess_;
  if (!had_estimate && judge(*found, options_) != TrackingStatus::tracking) {
    return;  // still initializing: the first estimate must be believable
  }
  report(*found);
  if (is_known()) {
    frames_searched_ = 0;
    predictor_.reset(frame.stamp, found->configuration);
    frames_in_sight_.assign(static_cast<std::size_t>(model_.tree.variables()), kFramesToKnowMotion);
    guess_ = found->configuration;
  }
}

void Tracker::follow(const DepthFrame& frame) {
  const Configuration prediction = with_hidden_joints_sought(predictor_.predict(frame.stamp));
  const RegistrationResult& registered = registration_.align(
      cloud_, prediction, {predictor_.spread(), options_.registration.max_iterations});
  const RegistrationResult& found =
      has_leapt(registered) ? with_leap_followed(frame, registered) : come_to_rest(registered);
  report(found);
  predictor_.update(frame.stamp, found.configuration, found.observable,
                    registration_.surface_distance(prediction, found.configuration));
  for (std::size_t v = 0; v < frames_in_sight_.size(); ++v) {
    frames_in_sight_[v] = found.observable[6 + v] ? frames_in_sight_[v] + 1 : 0;
    // One frame may mistake a stranger for the part that comes back; the second one tells.
    result_.observable[6 + v] = frames_in_sight_[v] >= kFramesToKnowMotion;
  }
  if (result_.status == TrackingStatus::tracking) {
    guess_ = found.configuration;
    frames_searched_ = 0;
  }
}

/// Gates stay as narrow as ever: wide ones drag parts onto each other, many steps do not.
const RegistrationResult& Tracker::come_to_rest(const RegistrationResult& registered) {
  const RegistrationResult* result = &registered;
  for (int round = 0; round < options_.most_rounds && result->last_move > options_.resting_move;
       ++round) {
    const Configuration start = result->configuration;
    result =
        &registration_.align(cloud_, start, {predictor_.spread(), options_.further_iterations});
  }
  return *result;
}

bool Tracker::is_hidden_at_once(const RegistrationResult& registered) const {
  return registered.agreement.explained < result_.explained - kSuddenlyHidden;
}

/// What leaps farther between two frames than the gate is wide is seen through where it was.
bool Tracker::has_leapt(const RegistrationResult& registered) const {
  return !is_believable(registered, options_) || is_hidden_at_once(registered);
}

/// Joints are sought over their ranges, then the base around where it was last believed to be.
const RegistrationResult& Tracker::with_leap_followed(const DepthFrame& frame,
                                                      const RegistrationResult& registered) {
  const bool is_hidden = is_hidden_at_once(registered);
  best_ = registered;
  list_contradicted_joints();
  if (!sought_joints_.empty()) {
    keep_if_better(
        registration_.align(cloud_, acquisition_.find_joints(best_.configuration, sought_joints_),
                            {options_.start_joint_spread, options_.start_joint_iterations}));
  }
  if (is_hidden) {  // by the object itself, when the estimate lies behind it
    keep_if_better(acquisition_.find_near(frame, *guess_));
  }
  if (judge(best_, options_) != TrackingStatus::tracking && search_is_due(frames_searched_++)) {
    const bool anywhere = options_.search_anywhere && frames_searched_ > kFramesOfDoubt;
    if (const auto found = acquisition_.find(frame, guess_, anywhere)) {
      keep_if_better(*found);
    }
    result_.searches = acquisition_.searches();
  }
  return best_;
}

void Tracker::keep_if_better(const RegistrationResult& registered) {
  if (is_more_convincing(registered.agreement, best_.agreement)) {
    best_ = registered;
  }
}

/// Those whose own body is seen through.
void Tracker::list_contradicted_joints() {
  sought_joints_.clear();
  for (std::size_t b = 0; b < best_.body_agreement.size(); ++b) {
    const int joint = model_.tree.bodies[b].parent_joint;
    if (joint < 0 || !is_contradicted(best_.body_agreement[b], options_)) {
      continue;
    }
    const int variable = model_.tree.joints[static_cast<std::size_t>(joint)].variable;
    if (!options_.registration.locked[static_cast<std::size_t>(variable)]) {
      sought_joints_.push_back(variable);
    }
  }
}

/// A joint that was hidden may have moved anywhere: what is seen of it decides where it is now.
Configuration Tracker::with_hidden_joints_sought(const Configuration& prediction) {
  sought_joints_.clear();
  for (int v = 0; v < model_.tree.variables(); ++v) {
    if (frames_in_sight_[static_cast<std::size_t>(v)] < kFramesToKnowMotion) {
      sought_joints_.push_back(v);
    }
  }
  return sought_joints_.empty() ? prediction : acquisition_.find_joints(prediction, sought_joints_);
}

void Tracker::report(const RegistrationResult& registered) {
  result_.configuration = registered.configuration;
  result_.covariance = registered.covariance;
  result_.sigma = registered.sigma;
  result_.observable = registered.observable;
  result_.residual_rms = registered.residual_rms;
  result_.explained = registered.agreement.explained;
  result_.contradicted = registered.agreement.contradicted;
  result_.occluded = registered.agreement.occluded;
  result_.status = judge(registered, options_);
}

}  // namespace lockbox
