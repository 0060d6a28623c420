// SPDX-License-Identifier: BSD-3-Clause
#include "tracker_loop.hpp"

#include <algorithm>

#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/verification/belief.hpp"

namespace lockbox {
namespace {

constexpr double kSuddenlyHidden = 0.15;  // of the visible surface, from one frame to the next
constexpr int kFramesOfDoubt = 4;         // until the object is sought anywhere
constexpr int kRepeatsToRest = 4;         // of an image, until what is found in it rests
constexpr int kFramesToDoubtParts = 30;   // without seeking them; a second

}  // namespace

Tracker::Loop::Loop(const ArticulatedModel& model, const TrackerOptions& options)
    : model_(model),
      options_(options),
      executor_(options.threads),
      registration_(model, options.registration, executor_),
      acquisition_(model, options, executor_, registration_, cloud_),
      predictor_(model.tree),
      verifier_(model.tree) {
  result_.configuration = unknown_configuration(model.tree);
  options_.registration.locked.resize(static_cast<std::size_t>(model.tree.variables()), false);
  frames_in_sight_.resize(options_.registration.locked.size(), 0);
  is_flush_.resize(frames_in_sight_.size(), false);
  if (options_.background_search) acquisition_.prepare();  // no frame waits for it then
}

void Tracker::Loop::start(const Configuration& configuration) {
  guess_ = configuration;
  is_kept_ = true;
  frames_searched_ = 0;
  rival_distance_ = 0.0;
  status_ = TrackingStatus::initializing;
  result_.status = status_;
  stop_searching();
}

bool Tracker::Loop::is_known() const {
  return status_ == TrackingStatus::tracking || status_ == TrackingStatus::uncertain;
}

/// Whether it is the last image again, once too often since the object was found in it to still
/// tell anything.
bool Tracker::Loop::shows_nothing_new(const DepthFrame& frame) {
  if (frame.camera == last_camera_ && frame.metres_per_unit == last_unit_ &&
      frame.depth == last_depth_) {
    repeats_ = is_known() && is_kept_ ? repeats_ + 1 : 0;
  } else {
    repeats_ = 0;
    last_depth_ = frame.depth;
    last_camera_ = frame.camera;
    last_unit_ = frame.metres_per_unit;
  }
  return repeats_ >= kRepeatsToRest;
}

const TrackingResult& Tracker::Loop::process(const DepthFrame& frame) {
  if (shows_nothing_new(frame)) {
    result_.stamp = frame.stamp;
    result_.cloud_time = {};
    result_.step_time = {};
    result_.latency_ms = 0.0;
    return result_;
  }
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
  if (status_ == TrackingStatus::tracking) stop_searching();
  report_status();
  result_.step_time = step_watch.elapsed();
  result_.latency_ms = result_.cloud_time.wall_ms + result_.step_time.wall_ms;
  return result_;
}

void Tracker::Loop::follow(const DepthFrame& frame) {
  const Configuration prediction = with_hidden_joints_sought(predictor_.predict(frame.stamp));
  const Answer registered =
      registration_.align(cloud_, prediction,
                          {.annealing_sigma = predictor_.annealing_sigma(),
                           .iterations = options_.registration.max_iterations,
                           .is_predicted = status_ == TrackingStatus::tracking});
  is_found_anew_ = false;
  const bool is_as_before = is_doubted_as_before(registered);
  if (is_as_before) ++frames_doubted_;
  const Answer followed = is_as_before ? with_doubts_kept(prediction, registered)
                          : has_leapt(registered)
                              ? with_leap_followed(frame, prediction, registered)
                              : come_to_rest(prediction, registered);
  const Answer found = rival_distance_ > 0.0 ? with_rival_sought(frame, followed) : followed;
  const bool was_believed = status_ == TrackingStatus::tracking;
  report(found);
  if (status_ == TrackingStatus::lost && !guess_) forget();
  if (is_found_anew_) size_record_ = {};  // of what it was taken for
  measure_size(found);
  is_kept_ = status_ == TrackingStatus::tracking || (is_kept_ && agrees(found, options_));
  if (is_found_anew_ || (!was_believed && status_ == TrackingStatus::tracking)) {
    predictor_.reset(frame.stamp, found.at_rest);  // from where it never was is no motion
  } else {
    predictor_.update(frame.stamp, found.at_rest, found.observable,
                      registration_.moves().between(prediction, found.at_rest));
  }
  count_frames_in_sight(found);
  if (status_ == TrackingStatus::tracking) {
    guess_ = found.at_rest;
    frames_searched_ = 0;
  }
}

void Tracker::Loop::measure_size(const Answer& found) {
  if (!is_known() || !size_record_.is_due()) return;
  size_record_.add(registration_.measure_size(found.configuration));
}

/// Bodies contradict the image that did so a frame ago, when all else was believed.
bool Tracker::Loop::is_doubted_as_before(const Answer& registered) const {
  if (doubted_.empty() || frames_doubted_ >= kFramesToDoubtParts) return false;
  const std::vector<int> now = contradicted_bodies(registered, options_);
  return !now.empty() && std::includes(doubted_.begin(), doubted_.end(), now.begin(), now.end());
}

/// A base that contradicts the image may be on its way elsewhere: then the image is asked again.
Answer Tracker::Loop::with_doubts_kept(const Configuration& prediction, const Answer& registered) {
  Answer kept = come_to_rest(prediction, registered);
  kept.belief = doubted_.front() == 0 ? belief_by_image(kept.configuration) : belief_;
  return kept;
}

/// Asks the image whether it is the object, if that decides.
void Tracker::Loop::verify(Answer& found) {
  if (is_believable(found, options_) || classify(found, options_) == TrackingStatus::lost) return;
  found.belief = belief_by_image(found.configuration);
  frames_doubted_ = 0;
}

/// One frame may mistake a stranger for the part that comes back; the second one tells.
void Tracker::Loop::count_frames_in_sight(const Answer& found) {
  for (int v = 0; v < model_.tree.variables(); ++v) {
    const auto unknown = static_cast<std::size_t>(6 + v);
    int& frames = frames_in_sight_[static_cast<std::size_t>(v)];
    const bool is_in_sight =
        found.observable[unknown] && !is_doubtful(found, v, hidden_margins_, model_.tree, options_);
    frames = is_in_sight ? frames + 1 : 0;
    result_.observable[unknown] = result_.observable[unknown] && frames >= kFramesToKnowMotion;
  }
}

/// Gates stay as narrow as ever: wide ones drag parts onto each other, many steps do not.
Answer Tracker::Loop::come_to_rest(const Configuration& prediction, const Answer& registered) {
  Answer result = registered;
  Configuration start = prediction;
  for (int round = 0; round < options_.most_rounds && is_on_its_way(start, result); ++round) {
    start = result.at_rest;
    result = registration_.align(cloud_, start, further());
  }
  return result;
}

/// From where the last alignment of the frame has ended.
AlignOptions Tracker::Loop::further() const {
  return {.annealing_sigma = predictor_.annealing_sigma(),
          .iterations = options_.further_iterations,
          .goes_on = true};
}

/// What has come farther than the gate is wide was pulled along by what little was within it, and
/// may be uncertain enough for steps of millimetres to be no more than noise.
bool Tracker::Loop::is_on_its_way(const Configuration& start, const Answer& result) const {
  return result.last_move > options_.resting_move ||
         registration_.moves().between(start, result.at_rest) >
             options_.registration.gate * predictor_.annealing_sigma();
}

bool Tracker::Loop::is_hidden_at_once(const Answer& registered) const {
  return registered.agreement.explained < result_.explained - kSuddenlyHidden;
}

/// What leaps farther between two frames than the gate is wide is seen through where it was.
bool Tracker::Loop::has_leapt(const Answer& registered) const {
  const bool is_explained =
      is_kept_ ? agrees(registered, options_) : is_believable(registered, options_);
  return !is_explained || is_hidden_at_once(registered);
}

/// Whether there is nothing to be sought.
bool Tracker::Loop::needs_no_search(const Answer& registered) const {
  return classify(registered, options_) == TrackingStatus::tracking ||
         (is_kept_ && agrees(registered, options_) && rests(registered, options_));
}

/// It is followed until it rests; joints are sought over their ranges, then the base around where
/// it was last believed to be. Live, what does not help in the first frame of doubt is left to the
/// search, which does all that, too.
Answer Tracker::Loop::with_leap_followed(const DepthFrame& frame, const Configuration& prediction,
                                         const Answer& registered) {
  const bool is_hidden = is_hidden_at_once(registered);
  Answer best = registered;
  if (!options_.background_search || frames_searched_ == 0) {
    // It may be on its way still: then nothing is to be sought.
    const Configuration start = best.at_rest;
    const Answer followed = registration_.align(cloud_, start, further());
    keep_better(come_to_rest(start, followed), options_, best);
    carry_parts(prediction, best);
    seek_contradicted_joints(best);
  }
  verify(best);
  if (is_hidden && guess_ && !options_.background_search) {
    // By itself, when the estimate lies behind it.
    keep_better(acquisition_.find_near(*guess_), options_, best);
  }
  if (!needs_no_search(best)) {
    const bool anywhere = options_.search_anywhere && frames_searched_ >= kFramesOfDoubt;
    if (const auto found = sought(frame, anywhere ? SearchScope::near_first : SearchScope::near)) {
      is_found_anew_ = keep_better(*found, options_, best);
    }
  }
  return best;
}

/// While the base was on its way, parts were dragged along by whatever lay near. Where it is now,
/// they start anew as predicted; of two answers that explain the image, that is the likelier one.
void Tracker::Loop::carry_parts(const Configuration& prediction, Answer& best) {
  const Configuration carried{best.at_rest.T_camera_base, prediction.q};
  const double gate = options_.registration.gate * predictor_.annealing_sigma();
  if (registration_.moves().between(prediction, carried) <= gate) return;
  const Answer registered = registration_.align(
      cloud_, carried, {predictor_.annealing_sigma(), options_.registration.max_iterations});
  const Answer at_rest = come_to_rest(carried, registered);
  if (classify(at_rest, options_) == TrackingStatus::tracking) {
    best = at_rest;
  } else {
    keep_better(at_rest, options_, best);
  }
}

}  // namespace lockbox
