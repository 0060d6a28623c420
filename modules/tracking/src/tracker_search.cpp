// SPDX-License-Identifier: BSD-3-Clause
// What the tracker does while it does not know where the object is.
#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "tracker_loop.hpp"

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

/// As when a camera is uncovered, or its cable is back.
bool is_another_view(std::ptrdiff_t measured, std::ptrdiff_t before) {
  constexpr double kOther = 0.2;  // of its pixels
  return static_cast<double>(std::abs(measured - before)) >
         kOther * static_cast<double>(std::max(measured, before));
}

}  // namespace

void Tracker::Loop::search(const DepthFrame& frame) {
  const SearchScope near_first = is_kept_ ? SearchScope::given_first : SearchScope::near_first;
  const auto found = sought(frame, options_.search_anywhere ? near_first : SearchScope::near);
  const bool is_first = status_ != TrackingStatus::lost && !guess_;
  // What was never found is not lost.
  if (!found || (is_first && classify(*found, options_) == TrackingStatus::lost)) {
    report_nothing();
    return;
  }
  report(*found);
  measure_size(*found);
  is_kept_ = status_ == TrackingStatus::tracking || (is_kept_ && agrees(*found, options_));
  if (is_known()) {
    if (status_ == TrackingStatus::tracking) {
      guess_ = found->at_rest;
      frames_searched_ = 0;
    }
    predictor_.reset(frame.stamp, found->at_rest);
    std::transform(found->observable.begin() + 6, found->observable.end(), frames_in_sight_.begin(),
                   [](bool is_known) { return is_known ? kFramesToKnowMotion : 0; });
  }
}

/// What is found in this frame, if a search is due, or one in the background has ended.
std::optional<Answer> Tracker::Loop::sought(const DepthFrame& frame, SearchScope scope) {
  const std::ptrdiff_t measured = measured_pixels(cloud_);
  if (is_another_view(measured, measured_before_)) {
    measured_before_ = measured;
    frames_searched_ = 0;
    acquisition_.begin_anew();
  }
  const bool is_near_due = search_is_due(frames_searched_, kLongestPauseNear);
  std::optional<Answer> found;
  if (options_.background_search) {
    found = sought_in_background(frame, scope, is_near_due);
  } else if (search_is_due(frames_searched_, kLongestPauseAnywhere)) {
    found = acquisition_.find(frame, guess_, scope);
    result_.searches = acquisition_.searches();
  } else if (is_near_due && guess_ && scope != SearchScope::anywhere) {
    found = acquisition_.find(frame, guess_, SearchScope::near);
  }
  ++frames_searched_;
  return found;
}

/// Where a search could not tell two places apart, following one of them does not, either: only
/// another search may.
Answer Tracker::Loop::with_rival_sought(const DepthFrame& frame, const Answer& followed) {
  Answer best = followed;
  if (!(best.rival_distance > 0.0)) doubt_base(rival_distance_, best);
  const auto found = sought(frame, SearchScope::anywhere);
  if (found &&
      (classify(*found, options_) == TrackingStatus::tracking || found->belief > result_.belief)) {
    best = *found;
    is_found_anew_ = true;
  }
  return best;
}

/// Nothing here takes longer than it may take to follow a leap.
std::optional<Answer> Tracker::Loop::sought_in_background(const DepthFrame& frame,
                                                          SearchScope scope, bool is_due) {
  if (!background_) {
    background_ = std::make_unique<BackgroundSearch>(model_, options_);
  }
  std::optional<Answer> found;
  background_->show(frame);
  if (const auto answer = background_->take()) found = brought_up_to_date(*answer);
  const auto is_found = [&] { return found && needs_no_search(*found); };
  // Following is no remedy where two places look alike: then only a search of the whole frame is.
  if (is_due && !is_found() && scope != SearchScope::anywhere) {
    if (auto here = where_it_was()) found = std::move(here);
  }
  result_.searches = background_->searches();
  if (!is_found() && !background_->is_busy()) {
    const bool is_misled = answers_passed_ > kMostAnswersPassed && scope != SearchScope::near;
    background_->start(frame, guess_, is_misled ? SearchScope::anywhere : scope);
    if (is_misled) answers_passed_ = 0;
  }
  return found;
}

/// The answer is a few frames old. If the object has gone too far since, the next search begins at
/// the answer: that takes less time, in which it goes less far.
std::optional<Answer> Tracker::Loop::brought_up_to_date(const Answer& answer) {
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
std::optional<Answer> Tracker::Loop::where_it_was() {
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

/// Over their whole ranges.
void Tracker::Loop::seek_contradicted_joints(Answer& best) {
  sought_joints_ = contradicted_variables(best, model_.tree, options_);
  if (!sought_joints_.empty()) {
    keep_better(acquisition_.with_joints_sought(best.at_rest, sought_joints_), options_, best);
  }
}

/// A joint that was hidden may have moved anywhere: what is seen of it decides where it is now.
Configuration Tracker::Loop::with_hidden_joints_sought(const Configuration& prediction) {
  sought_joints_.clear();
  for (int v = 0; v < model_.tree.variables(); ++v) {
    const auto variable = static_cast<std::size_t>(v);
    if (frames_in_sight_[variable] < kFramesToKnowMotion && !is_flush_[variable]) {
      sought_joints_.push_back(v);
    }
  }
  hidden_margins_.clear();
  if (sought_joints_.empty()) return prediction;
  SoughtJoints sought = acquisition_.find_joints(prediction, sought_joints_);
  hidden_margins_ = std::move(sought.margins);
  return sought.configuration;
}

const std::optional<SearchFailure>& Tracker::Loop::search_failure() const {
  return background_ ? background_->failure() : acquisition_.failure();
}

void Tracker::Loop::stop_searching() {
  if (background_) background_->cancel();
  acquisition_.begin_anew();
  answers_passed_ = 0;
}

}  // namespace lockbox
