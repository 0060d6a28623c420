// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker.hpp"

#include <chrono>

namespace lockbox {

std::string to_string(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::initializing:
      return "initializing";
    case TrackingStatus::tracking:
      return "tracking";
    case TrackingStatus::uncertain:
      return "uncertain";
    case TrackingStatus::lost:
      return "lost";
  }
  return "lost";
}

Tracker::Tracker(const ArticulatedModel& model, const TrackerOptions& options)
    : model_(model),
      options_(options),
      executor_(options.threads),
      registration_(model, options.registration, executor_),
      predictor_(model.tree) {}

void Tracker::start(const Configuration& configuration) {
  start_ = configuration;
}

const TrackingResult& Tracker::process(const DepthFrame& frame) {
  const auto began = std::chrono::steady_clock::now();
  cloud_.assign(frame, options_.cloud, executor_);
  result_.stamp = frame.stamp;
  if (start_) {
    predictor_.reset(frame.stamp, *start_);
    const RegistrationResult& found = find_start(*start_);
    judge(found);
    predictor_.reset(frame.stamp, found.configuration);
    start_.reset();
  } else if (result_.status != TrackingStatus::initializing) {
    const Configuration prediction = predictor_.predict(frame.stamp);
    const RegistrationResult& found = registration_.align(
        cloud_, prediction, {predictor_.spread(), options_.registration.max_iterations});
    judge(found);
    predictor_.update(frame.stamp, found.configuration, found.observable,
                      registration_.surface_distance(prediction, found.configuration));
  }
  result_.latency_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  return result_;
}

const RegistrationResult& Tracker::find_start(const Configuration& start) {
  const Configuration placed =
      registration_.align(cloud_, start, {options_.start_spread, options_.start_iterations, true})
          .configuration;
  return registration_.align(cloud_, placed,
                             {options_.start_joint_spread, options_.start_joint_iterations});
}

void Tracker::judge(const RegistrationResult& registered) {
  result_.configuration = registered.configuration;
  result_.covariance = registered.covariance;
  result_.sigma = registered.sigma;
  result_.observable = registered.observable;
  result_.residual_rms = registered.residual_rms;
  const Agreement& agreement = registered.agreement;
  result_.explained = agreement.explained;
  result_.contradicted = agreement.contradicted;
  result_.occluded = agreement.occluded;

  const double decided = agreement.explained + agreement.contradicted;
  const double share = decided > 0.0 ? agreement.explained / decided : 0.0;
  if (agreement.explained >= options_.least_explained && share >= options_.least_agreement) {
    result_.status = TrackingStatus::tracking;
  } else if (agreement.explained < 0.5 * options_.least_explained ||
             share < options_.lost_agreement) {
    result_.status = TrackingStatus::lost;
  } else {
    result_.status = TrackingStatus::uncertain;
  }
}

}  // namespace lockbox
