// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker.hpp"

#include <chrono>

namespace lockbox {
namespace {

constexpr int kFramesToKnowMotion = 2;  // a joint that comes back into sight is sought until then
constexpr int kLongestSearchPause = 8;  // frames

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
  const auto began = std::chrono::steady_clock::now();
  cloud_.assign(frame, options_.cloud, executor_);
  result_.stamp = frame.stamp;
  if (is_known()) {
    follow(frame);
  } else {
    search(frame);
  }
  result_.latency_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
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
  if (!had_estimate && judge(found->agreement, options_) == TrackingStatus::lost) {
    return;  // still initializing: an answer that nobody believes is no estimate
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
  const RegistrationResult& found = registration_.align(
      cloud_, prediction, {predictor_.spread(), options_.registration.max_iterations});
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
  }
}

/// A joint that was hidden may have moved anywhere: what is seen of it decides where it is now.
Configuration Tracker::with_hidden_joints_sought(const Configuration& prediction) {
  hidden_joints_.clear();
  for (int v = 0; v < model_.tree.variables(); ++v) {
    if (frames_in_sight_[static_cast<std::size_t>(v)] < kFramesToKnowMotion) {
      hidden_joints_.push_back(v);
    }
  }
  return hidden_joints_.empty() ? prediction : acquisition_.find_joints(prediction, hidden_joints_);
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
  result_.status = judge(registered.agreement, options_);
}

}  // namespace lockbox
