// SPDX-License-Identifier: BSD-3-Clause
#include "tracker_loop.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lockbox/solver/motion_metric.hpp"
#include "lockbox/tracking/classification.hpp"
#include "lockbox/tracking/stopwatch.hpp"

namespace lockbox {
namespace {

constexpr double kSuddenlyHidden = 0.15;  // of the visible surface, from one frame to the next
constexpr int kFramesOfDoubt = 4;         // until the object is sought anywhere
constexpr int kFramesToDoubtParts = 30;   // without seeking them; a second

/// What a program or a user has said of the noise is not looked for.
bool is_noise_given(const RegistrationOptions& registration) {
  const RegistrationOptions usual;
  return registration.noise != usual.noise ||
         registration.noise_correlation != usual.noise_correlation ||
         registration.contour_correlation != usual.contour_correlation;
}

}  // namespace

Tracker::Loop::Loop(const ArticulatedModel& model, const TrackerOptions& options)
    : model_(model),
      options_(options),
      executor_(options.threads),
      registration_(model, options.registration, executor_),
      acquisition_(model, options, executor_, registration_, cloud_),
      search_(model, options_, registration_, acquisition_, cloud_),
      image_belief_(model.tree, cloud_, options_, executor_),
      rivals_(acquisition_.look_alikes(), options_, registration_, cloud_, image_belief_),
      report_(model.tree, options_, image_belief_),
      predictor_(model.tree),
      joint_sight_(model.tree),
      noise_(is_noise_given(options.registration) ? 0 : options.frames_between_noises) {
  options_.registration.locked.resize(static_cast<std::size_t>(model.tree.variables()), false);
  if (options_.background_search) acquisition_.prepare();  // no frame waits for it then
}

void Tracker::Loop::start(const Configuration& configuration) {
  is_kept_ = true;
  verdict_ = {};
  report_.restart();
  search_.believe(configuration);
  search_.stop();
}

const TrackingResult& Tracker::Loop::process(const DepthFrame& frame) {
  if (repeated_image_.shows_nothing_new(frame, verdict_.is_known() && is_kept_)) {
    report_.repeat(frame.stamp);
    return report_.result();
  }
  const Stopwatch cloud_watch;
  cloud_.assign(frame, options_.cloud, executor_);
  report_.begin(frame.stamp, cloud_watch.elapsed());
  const Stopwatch step_watch;
  follow_noise(frame);
  if (verdict_.is_known()) {
    follow(frame);
  } else {
    search(frame);
  }
  if (verdict_.status == TrackingStatus::tracking) search_.stop();
  report_.end(verdict_, size_record_.mean(), search_.searches(), step_watch.elapsed());
  return report_.result();
}

/// Alignments and searches are made for a noise. Those in the background go by that of the first.
void Tracker::Loop::follow_noise(const DepthFrame& frame) {
  const auto noise = noise_.changed_by(frame, options_.registration.noise);
  if (!noise) return;
  assume_noise(*noise, options_.registration);
  if (!options_.background_search || !is_noise_known_) acquisition_.assume(options_.registration);
  is_noise_known_ = true;
  registration_ = ArticulatedRegistration(model_, options_.registration, executor_);
}

/// `tracking` and `uncertain`: the object is where it is predicted, or else has leapt; then it is
/// sought near there, later anywhere.
void Tracker::Loop::follow(const DepthFrame& frame) {
  const SoughtJoints predicted = with_hidden_joints_sought(predictor_.predict(frame.stamp));
  const Configuration& prediction = predicted.configuration;
  const bool was_believed = verdict_.status == TrackingStatus::tracking;
  FrameAlignment alignment(registration_, cloud_, options_, predictor_.annealing_sigma());
  const Answer registered = alignment.once(prediction, was_believed);
  Followed followed;
  if (is_doubted_as_before(registered)) {
    followed = {with_doubts_kept(alignment.until_rest(prediction, registered))};
  } else if (has_leapt(registered)) {
    followed = with_leap_followed(frame, prediction, registered, alignment);
  } else {
    followed = {alignment.until_rest(prediction, registered)};
  }
  if (followed.is_found_anew) begin_comparison(followed.answer);
  if (verdict_.rival_distance > 0.0) followed = with_rival_sought(frame, followed);
  auto& [found, is_found_anew] = followed;
  report(found);
  if (verdict_.status == TrackingStatus::lost && !search_.guess()) {
    verdict_ = {};  // what was never sure is not lost: it is sought as at the start
    report_.forget();
  }
  if (is_found_anew) size_record_ = {};  // of what it was taken for
  measure_size(found);
  const bool is_believed_now = verdict_.status == TrackingStatus::tracking;
  is_kept_ = is_believed_now || (is_kept_ && agrees(found, options_));
  if (is_found_anew || (!was_believed && is_believed_now)) {
    predictor_.reset(frame.stamp, found.at_rest);  // from where it never was is no motion
  } else {
    predictor_.update(frame.stamp, found.at_rest, found.observable,
                      registration_.moves().between(prediction, found.at_rest));
  }
  joint_sight_.count(found, predicted.margins, options_);
  report_.withhold_unknown(joint_sight_);
  if (is_believed_now) search_.believe(found.at_rest);
}

/// `initializing` and `lost`: the object is sought where it was last believed to be, then anywhere.
void Tracker::Loop::search(const DepthFrame& frame) {
  const SearchScope near_first = is_kept_ ? SearchScope::given_first : SearchScope::near_first;
  const SearchScope scope = options_.search_anywhere ? near_first : SearchScope::near;
  auto found = search_.seek(frame, scope, is_kept_);
  const bool is_first = verdict_.status != TrackingStatus::lost && !search_.guess();
  // What was never found is not lost.
  if (!found || (is_first && classify(*found, options_) == TrackingStatus::lost)) {
    report_.write_nothing();
    return;
  }
  begin_comparison(*found);
  size_record_ = {};  // of what was taken for it while it was out of view, too
  report(*found);
  measure_size(*found);
  const bool is_believed = verdict_.status == TrackingStatus::tracking;
  is_kept_ = is_believed || (is_kept_ && agrees(*found, options_));
  if (!verdict_.is_known()) return;
  if (is_believed) search_.believe(found->at_rest);
  predictor_.reset(frame.stamp, found->at_rest);
  joint_sight_.begin(*found);
}

/// A joint that was hidden may have moved anywhere: what is seen of it decides where it is now.
SoughtJoints Tracker::Loop::with_hidden_joints_sought(const Configuration& prediction) {
  const std::vector<int> hidden = joint_sight_.sought();
  if (hidden.empty()) return {.configuration = prediction, .margins = {}};
  return acquisition_.find_joints(prediction, hidden);
}

/// Bodies contradict the image that did so a frame ago, when all else was believed.
bool Tracker::Loop::is_doubted_as_before(const Answer& registered) const {
  const std::vector<int>& before = verdict_.doubted;
  if (before.empty() || frames_doubted_ >= kFramesToDoubtParts) return false;
  const std::vector<int> now = contradicted_bodies(registered, options_);
  return !now.empty() && std::includes(before.begin(), before.end(), now.begin(), now.end());
}

/// A base that contradicts the image may be on its way elsewhere: then the image is asked again.
Answer Tracker::Loop::with_doubts_kept(Answer followed) {
  ++frames_doubted_;
  const bool is_base = verdict_.doubted.front() == 0;
  followed.belief = is_base ? image_belief_.of(followed.configuration) : verdict_.belief;
  return followed;
}

bool Tracker::Loop::is_hidden_at_once(const Answer& registered) const {
  return registered.agreement.explained < report_.result().explained - kSuddenlyHidden;
}

/// What leaps farther between two frames than the gate is wide is seen through where it was.
bool Tracker::Loop::has_leapt(const Answer& registered) const {
  const bool is_explained =
      is_kept_ ? agrees(registered, options_) : is_believable(registered, options_);
  return !is_explained || is_hidden_at_once(registered);
}

/// It is followed until it rests; joints are sought over their ranges, then the base around where
/// it was last believed to be. Live, what does not help in the first frame of doubt is left to the
/// search, which does all that, too.
Tracker::Loop::Followed Tracker::Loop::with_leap_followed(const DepthFrame& frame,
                                                          const Configuration& prediction,
                                                          const Answer& registered,
                                                          FrameAlignment& alignment) {
  const bool is_hidden = is_hidden_at_once(registered);
  Followed best{registered};
  if (!options_.background_search || search_.frames_searched() == 0) {
    // It may be on its way still: then nothing is to be sought.
    keep_better(alignment.followed(registered.at_rest), options_, best.answer);
    alignment.carry_parts(prediction, best.answer);
    seek_contradicted_joints(best.answer);
  }
  verify(best.answer);
  if (is_hidden && search_.guess() && !options_.background_search) {
    // By itself, when the estimate lies behind it.
    keep_better(acquisition_.find_near(*search_.guess()), options_, best.answer);
  }
  if (needs_no_search(best.answer, is_kept_, options_)) return best;
  const bool anywhere = options_.search_anywhere && search_.frames_searched() >= kFramesOfDoubt;
  const SearchScope scope = anywhere ? SearchScope::near_first : SearchScope::near;
  if (const auto found = search_.seek(frame, scope, is_kept_)) {
    best.is_found_anew = keep_better(*found, options_, best.answer);
  }
  return best;
}

/// Where a search could not tell two places apart, following one of them does not, either: the next
/// frames are asked for these, then another search.
Tracker::Loop::Followed Tracker::Loop::with_rival_sought(const DepthFrame& frame,
                                                         const Followed& followed) {
  Followed best = followed;
  const bool is_hopeless = rivals_.is_hopeless(best.answer);
  if (!followed.is_found_anew && !is_hopeless && !rivals_.has_ended()) {
    if (const auto told = rivals_.compare(best.answer)) return {told->answer, told->is_rival};
  }
  if (!(best.answer.rival_distance > 0.0)) doubt_base(verdict_.rival_distance, best.answer);
  // An image that shows it does not say that it shows no rival.
  best.answer.belief = std::min(best.answer.belief, report_.result().belief);
  if (is_hopeless || !rivals_.has_ended()) return best;
  const auto found = search_.seek(frame, SearchScope::anywhere, is_kept_);
  if (found && (classify(*found, options_) == TrackingStatus::tracking ||
                found->belief > report_.result().belief)) {
    best = {*found, true};
    begin_comparison(best.answer);
  }
  return best;
}

void Tracker::Loop::begin_comparison(Answer& found) {
  const auto doubt = rivals_.begin(found, search_.alternatives());
  if (!doubt) return;
  found.belief = std::min(found.belief, doubt->belief);
  if (!(found.rival_distance > 0.0)) doubt_base(doubt->rival_distance, found);
}

/// Seeks them over their whole ranges.
void Tracker::Loop::seek_contradicted_joints(Answer& best) {
  const std::vector<int> variables = contradicted_variables(best, model_.tree, options_);
  if (variables.empty()) return;
  keep_better(acquisition_.with_joints_sought(best.at_rest, variables), options_, best);
}

/// Asks the image whether it is the object, if that decides.
void Tracker::Loop::verify(Answer& found) {
  if (is_believable(found, options_) || classify(found, options_) == TrackingStatus::lost) return;
  found.belief = image_belief_.of(found.configuration);
  frames_doubted_ = 0;
}

void Tracker::Loop::report(Answer& answer) {
  size_record_.add_misfit(answer);
  joint_sight_.note_flush_parts(answer, options_);
  const Verdict before = verdict_;
  verdict_ = verdict_on(answer, options_);
  report_.write(answer, before, verdict_, search_.alternatives());
}

void Tracker::Loop::measure_size(const Answer& found) {
  if (!verdict_.is_known() || !size_record_.is_due()) return;
  size_record_.add(registration_.measure_size(cloud_, found.configuration));
}

}  // namespace lockbox
