// SPDX-License-Identifier: BSD-3-Clause
#include "object_search.hpp"

#include <algorithm>
#include <cstdlib>

namespace lockbox {
namespace {

// Frames. Doubled, an object that comes back is found up to so much later, and a recording without
// it takes half as long.
constexpr int kLongestPauseNear = 8;       // where it was: a few alignments
constexpr int kLongestPauseAnywhere = 64;  // two seconds; a search takes as long as many frames
constexpr int kMostAnswersPassed = 2;  // in a row by the object; after that, the answers are wrong

/// While nothing is found, a search pauses for longer and longer.
bool search_is_due(int frames_searched, int longest_pause) {
  if (frames_searched < longest_pause) {
    return (frames_searched & (frames_searched - 1)) == 0;  // 0, 1, 2, 4, ...
  }
  return frames_searched % longest_pause == 0;
}

std::ptrdiff_t measured_pixels(const TiledCloud& cloud) {
  return std::count_if(cloud.depth().begin(), cloud.depth().end(),
                       [](float depth) { return depth > 0.0F; });
}

/// Returns whether the view is another one, as when a camera is uncovered, or its cable is back.
bool is_another_view(std::ptrdiff_t measured, std::ptrdiff_t before) {
  constexpr double kOther = 0.2;  // of its pixels
  return static_cast<double>(std::abs(measured - before)) >
         kOther * static_cast<double>(std::max(measured, before));
}

}  // namespace

ObjectSearch::ObjectSearch(const ArticulatedModel& model, const TrackerOptions& options,
                           ArticulatedRegistration& registration, Acquisition& acquisition,
                           const TiledCloud& cloud)
    : model_(model),
      options_(options),
      registration_(registration),
      acquisition_(acquisition),
      cloud_(cloud) {}

void ObjectSearch::believe(const Configuration& configuration) {
  guess_ = configuration;
  frames_searched_ = 0;
}

void ObjectSearch::stop() {
  if (background_) background_->cancel();
  acquisition_.begin_anew();
  answers_passed_ = 0;
}

std::optional<Answer> ObjectSearch::seek(const DepthFrame& frame, SearchScope scope, bool is_kept) {
  const std::ptrdiff_t measured = measured_pixels(cloud_);
  if (is_another_view(measured, measured_before_)) {
    measured_before_ = measured;
    frames_searched_ = 0;
    acquisition_.begin_anew();
  }
  const bool is_near_due = search_is_due(frames_searched_, kLongestPauseNear);
  std::optional<Answer> found;
  if (options_.background_search) {
    found = seek_in_background(frame, scope, is_near_due, is_kept);
  } else if (search_is_due(frames_searched_, kLongestPauseAnywhere)) {
    found = acquisition_.find(frame, guess_, scope);
  } else if (is_near_due && guess_ && scope != SearchScope::anywhere) {
    found = acquisition_.find(frame, guess_, SearchScope::near);
  }
  ++frames_searched_;
  return found;
}

/// Nothing here takes longer than it may take to follow a leap.
std::optional<Answer> ObjectSearch::seek_in_background(const DepthFrame& frame, SearchScope scope,
                                                       bool is_due, bool is_kept) {
  if (!background_) {
    background_ = std::make_unique<BackgroundSearch>(model_, options_);
  }
  std::optional<Answer> found;
  background_->show(frame);
  if (const auto answer = background_->take()) found = brought_up_to_date(*answer);
  const auto is_found = [&] { return found && needs_no_search(*found, is_kept, options_); };
  // Following is no remedy where two places look alike: then only a search of the whole frame is.
  if (is_due && !is_found() && scope != SearchScope::anywhere) {
    if (auto here = where_it_was()) found = std::move(here);
  }
  if (!is_found() && !background_->is_busy()) {
    const bool is_misled = answers_passed_ > kMostAnswersPassed && scope != SearchScope::near;
    background_->start(frame, guess_, is_misled ? SearchScope::anywhere : scope);
    if (is_misled) answers_passed_ = 0;
  }
  return found;
}

/// The answer is a few frames old. If the object has gone too far since, the next search begins at
/// the answer: that takes less time, in which it goes less far.
std::optional<Answer> ObjectSearch::brought_up_to_date(const Answer& answer) {
  if (classify(answer, options_) == TrackingStatus::lost) return std::nullopt;
  Answer here = registration_.align(
      cloud_, answer.at_rest, {options_.start_joint_sigma, options_.registration.max_iterations});
  here.belief = answer.belief;
  const auto is_tracking = [this](const Answer& registered) {
    return classify(registered, options_) == TrackingStatus::tracking;
  };
  if (!is_tracking(here)) {
    keep_better(registration_.align(cloud_, here.at_rest,
                                    {options_.start_joint_sigma, options_.further_iterations}),
                options_, here);
  }
  if (is_tracking(here) || !is_tracking(answer)) {
    keep_doubts(answer, here);
    return here;
  }
  guess_ = answer.at_rest;
  ++answers_passed_;
  return std::nullopt;
}

/// What only stood between comes back into view where it was, whatever a search is busy with.
std::optional<Answer> ObjectSearch::where_it_was() {
  if (!guess_) {
    return std::nullopt;
  }
  const double annealing_sigma = options_.start_joint_sigma;
  const Answer at_a_glance = registration_.align(cloud_, *guess_, {annealing_sigma, 0});
  if (classify(at_a_glance, options_) == TrackingStatus::lost) return std::nullopt;
  Answer here =
      registration_.align(cloud_, *guess_, {annealing_sigma, options_.registration.max_iterations});
  if (classify(here, options_) != TrackingStatus::tracking) return std::nullopt;
  return here;
}

int ObjectSearch::searches() const {
  return background_ ? background_->searches() : acquisition_.searches();
}

const std::optional<SearchFailure>& ObjectSearch::failure() const {
  return background_ ? background_->failure() : acquisition_.failure();
}

const std::vector<Alternative>& ObjectSearch::alternatives() const {
  return background_ ? background_->alternatives() : acquisition_.alternatives();
}

}  // namespace lockbox
