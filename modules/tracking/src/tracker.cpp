// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker.hpp"

#include <chrono>

#include "lockbox/cloud/segmentation.hpp"

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
    const RegistrationResult& found = find_start(frame, *start_);
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

/// Only the points that may be the object: table, walls and clutter would pull at wide gates.
void Tracker::keep_object(const Configuration& start, double margin) {
  BodyPoses poses;
  forward_kinematics(model_.tree, start, poses);
  std::vector<ExpectedBody> expected;
  for (std::size_t b = 0; b < model_.fields.size(); ++b) {
    if (model_.fields[b]) {
      expected.push_back({poses[b], model_.fields[b]->bounds()});
    }
  }
  if (const auto mask = ObjectSegmenter().segment(cloud_, expected, margin)) {
    cloud_.keep(*mask);
  }
}

const RegistrationResult& Tracker::find_start(const DepthFrame& frame, const Configuration& start) {
  keep_object(start, options_.start_margin);
  const Configuration placed =
      registration_.align(cloud_, start, {options_.start_spread, options_.start_iterations, true})
          .configuration;
  cloud_.assign(frame, options_.cloud, executor_);
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
