// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/background_search.hpp"

#include <cassert>
#include <limits>
#include <utility>

namespace lockbox {
namespace {

/// So old an answer may be: about two frames, through which a frame's own steps can follow.
constexpr std::chrono::milliseconds kFresh(70);
/// Each takes less time than the one before, in which things move less far.
constexpr int kMostRoundsToCatchUp = 4;

}  // namespace

/// All that a search writes to, so that it shares nothing with the tracker but the model.
struct BackgroundSearch::Seeker {
  TiledCloud cloud;
  ArticulatedRegistration registration;
  Acquisition acquisition;

  Seeker(const ArticulatedModel& model, const TrackerOptions& options, const Executor& executor)
      : registration(model, options.registration, executor),
        acquisition(model, options, executor, registration, cloud) {}
};

// Its loops leave the workers to those of the tracker. Its thread is as good as any: where other
// programs keep the cores busy, one of lower priority would take ten times as long to find
// anything.
BackgroundSearch::BackgroundSearch(const ArticulatedModel& model, const TrackerOptions& options)
    : model_(model), options_(options), executor_(options.threads, Priority::low) {
  options_.search_limit = std::numeric_limits<double>::infinity();
  options_.stop_request = [this, of_the_user = options.stop_request] {
    return is_cancelled_ || (of_the_user && of_the_user());
  };
}

BackgroundSearch::~BackgroundSearch() {
  cancel();
}

void BackgroundSearch::start(const DepthFrame& frame, const std::optional<Configuration>& guess,
                             SearchScope scope) {
  assert(!is_busy());
  frame_ = frame;
  has_newer_ = false;
  is_cancelled_ = false;
  executor_.resume();
  running_ = std::async(std::launch::async, [this, guess, scope] { return find(guess, scope); });
}

std::optional<Answer> BackgroundSearch::find(const std::optional<Configuration>& guess,
                                             SearchScope scope) {
  // Here, because it takes a while: what the camera sees meanwhile need not wait.
  if (!seeker_) seeker_ = std::make_unique<Seeker>(model_, options_, executor_);
  seeker_->cloud.assign(frame_, options_.cloud, executor_);
  std::optional<Answer> answer = seeker_->acquisition.find(frame_, guess, scope);
  if (answer) catch_up(*answer);
  return answer;
}

/// Base and joints may have gone far while they were sought: they are sought around where they
/// were, again and again, which takes longer than a frame may take.
void BackgroundSearch::catch_up(Answer& answer) {
  const auto is_tracking = [this](const Answer& found) {
    return classify(found, options_) == TrackingStatus::tracking;
  };
  for (int round = 0; round < kMostRoundsToCatchUp && is_tracking(answer); ++round) {
    if (!take_newest()) return;
    seeker_->cloud.assign(frame_, options_.cloud, executor_);
    std::optional<Answer> followed =
        seeker_->acquisition.find(frame_, answer.at_rest, SearchScope::near);
    if (!followed || !is_tracking(*followed)) return;
    keep_doubts(answer, *followed);
    answer = *followed;
    if (Clock::now() - shown_at_ < kFresh) return;
  }
}

void BackgroundSearch::show(const DepthFrame& frame) {
  if (!is_busy()) return;
  const std::lock_guard lock(newest_mutex_);
  newest_ = frame;
  newest_shown_at_ = Clock::now();
  has_newer_ = true;
}

/// Makes it the search's own; false if it is already.
bool BackgroundSearch::take_newest() {
  const std::lock_guard lock(newest_mutex_);
  if (!has_newer_) return false;
  std::swap(frame_, newest_);
  shown_at_ = newest_shown_at_;
  has_newer_ = false;
  return true;
}

std::optional<Answer> BackgroundSearch::take() {
  if (!is_busy() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  std::optional<Answer> answer;
  try {
    answer = running_.get();
  } catch (const Stopped&) {
    answer.reset();
  }
  if (seeker_) {
    searches_ = seeker_->acquisition.searches();
    failure_ = seeker_->acquisition.failure();
    alternatives_ = seeker_->acquisition.alternatives();
  }
  return is_cancelled_ ? std::nullopt : std::move(answer);
}

void BackgroundSearch::cancel() {
  is_cancelled_ = true;
  executor_.stop();
}

}  // namespace lockbox
