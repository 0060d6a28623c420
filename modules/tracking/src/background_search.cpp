// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/background_search.hpp"

#include <cassert>
#include <chrono>

#include "lockbox/tracking/acquisition.hpp"

namespace lockbox {

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
    : model_(model), options_(options), executor_(options.threads, Priority::low) {}

BackgroundSearch::~BackgroundSearch() {
  executor_.stop();
}

void BackgroundSearch::start(const DepthFrame& frame, const std::optional<Configuration>& guess,
                             bool anywhere) {
  assert(!is_busy());
  frame_ = frame;
  is_cancelled_ = false;
  executor_.resume();
  running_ = std::async(std::launch::async, [this, guess, anywhere] {
    // Here, because it takes a while: what the camera sees meanwhile need not wait.
    if (!seeker_) seeker_ = std::make_unique<Seeker>(model_, options_, executor_);
    seeker_->cloud.assign(frame_, options_.cloud, executor_);
    return seeker_->acquisition.find(frame_, guess, anywhere);
  });
}

std::optional<RegistrationResult> BackgroundSearch::take() {
  if (!is_busy() || running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  Answer answer;
  try {
    answer = running_.get();
  } catch (const Stopped&) {
    answer.reset();
  }
  if (seeker_) searches_ = seeker_->acquisition.searches();
  return is_cancelled_ ? std::nullopt : std::move(answer);
}

void BackgroundSearch::cancel() {
  is_cancelled_ = true;
  executor_.stop();
}

}  // namespace lockbox
