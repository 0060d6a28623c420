// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker.hpp"

#include "tracker_loop.hpp"

namespace lockbox {

Tracker::Tracker(const ArticulatedModel& model, const TrackerOptions& options)
    : loop_(std::make_unique<Loop>(model, options)) {}

Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

void Tracker::start(const Configuration& configuration) {
  loop_->start(configuration);
}

const TrackingResult& Tracker::process(const DepthFrame& frame) {
  return loop_->process(frame);
}

const std::optional<SearchFailure>& Tracker::search_failure() const {
  return loop_->search_failure();
}

const TiledCloud& Tracker::cloud() const {
  return loop_->cloud();
}
const TrackerOptions& Tracker::options() const {
  return loop_->options();
}

}  // namespace lockbox
