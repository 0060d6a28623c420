// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/acquisition.hpp"

#include "lockbox/cloud/segmentation.hpp"

namespace lockbox {
namespace {

/// A contradiction counts more than what remains unexplained: that may be hidden.
double conviction(const Agreement& agreement) {
  return agreement.explained - 2.0 * agreement.contradicted;
}

}  // namespace

Acquisition::Acquisition(const ArticulatedModel& model, const TrackerOptions& options,
                         const Executor& executor, ArticulatedRegistration& registration,
                         TiledCloud& cloud)
    : model_(model),
      options_(options),
      executor_(executor),
      registration_(registration),
      cloud_(cloud) {}

std::optional<RegistrationResult> Acquisition::find(const DepthFrame& frame,
                                                    const std::optional<Configuration>& guess,
                                                    bool anywhere) {
  best_.reset();
  const Annealing narrow{options_.start_joint_spread, options_.start_joint_iterations};
  if (guess) {
    if (try_from(*guess, narrow)) {
      return best_;
    }
    Configuration placed = *guess;
    place_base(frame, placed);
    if (try_from(placed, narrow)) {
      return best_;
    }
  }
  if (anywhere) {
    ++searches_;
    for (const Candidate& candidate : initializer().find(cloud_)) {
      if (try_from(candidate.configuration, narrow)) {
        return best_;
      }
    }
  }
  return best_;
}

/// Registers from there; true if the result is judged `tracking`.
bool Acquisition::try_from(const Configuration& start, const Annealing& annealing) {
  const RegistrationResult& found = registration_.align(cloud_, start, annealing);
  if (!best_ || conviction(found.agreement) > conviction(best_->agreement)) {
    best_ = found;
  }
  return judge(found.agreement, options_) == TrackingStatus::tracking;
}

/// The base alone, within a wide gate.
void Acquisition::place_base(const DepthFrame& frame, Configuration& configuration) {
  keep_object(configuration);
  configuration =
      registration_
          .align(cloud_, configuration, {options_.start_spread, options_.start_iterations, true})
          .configuration;
  cloud_.assign(frame, options_.cloud, executor_);
}

/// Only the points that may be the object: table, walls and clutter would pull at wide gates.
void Acquisition::keep_object(const Configuration& start) {
  BodyPoses poses;
  forward_kinematics(model_.tree, start, poses);
  std::vector<ExpectedBody> expected;
  for (std::size_t b = 0; b < model_.fields.size(); ++b) {
    if (model_.fields[b]) {
      expected.push_back({poses[b], model_.fields[b]->bounds()});
    }
  }
  if (const auto mask = ObjectSegmenter().segment(cloud_, expected, options_.start_margin)) {
    cloud_.keep(*mask);
  }
}

Configuration Acquisition::find_joints(const Configuration& start,
                                       const std::vector<int>& variables) {
  return initializer().find_joints(cloud_, start, variables);
}

Initializer& Acquisition::initializer() {
  if (!initializer_) {
    InitializerOptions options{options_.registration};
    options.registration.fixed_base = false;  // it is held where it was found
    initializer_.emplace(model_, options, executor_);
  }
  return *initializer_;
}

}  // namespace lockbox
