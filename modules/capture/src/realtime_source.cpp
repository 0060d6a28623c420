// SPDX-License-Identifier: BSD-3-Clause
#include "realtime_source.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace lockbox {
namespace {

constexpr std::chrono::milliseconds kLook(100);  // between looks at whether to stop

}  // namespace

RealtimeSource::RealtimeSource(std::unique_ptr<FrameSource> recording, std::function<bool()> stop)
    : recording_(std::move(recording)), stop_(std::move(stop)) {}

RealtimeSource::Clock::time_point RealtimeSource::due(const DepthFrame& frame) const {
  return start_ + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(frame.stamp - first_stamp_));
}

/// Returns false if it was told to stop.
bool RealtimeSource::wait_until(Clock::time_point time) const {
  for (auto now = Clock::now(); now < time; now = Clock::now()) {
    if (stop_ && stop_()) {
      return false;
    }
    std::this_thread::sleep_until(std::min<Clock::time_point>(time, now + kLook));
  }
  return true;
}

/// And reads the one after it.
void RealtimeSource::take_pending(DepthFrame& frame) {
  file_ = recording_->file_of_frame();
  std::swap(frame, pending_);
  has_pending_ = recording_->next(pending_);
}

bool RealtimeSource::next(DepthFrame& frame) {
  if (!started_) {
    started_ = true;
    has_pending_ = recording_->next(pending_);
    start_ = Clock::now();
    first_stamp_ = pending_.stamp;
  }
  if (!has_pending_ || !wait_until(due(pending_))) {
    return false;
  }
  take_pending(frame);
  while (has_pending_ && due(pending_) <= Clock::now()) {
    take_pending(frame);
    ++dropped_;
  }
  return true;
}

SourceFaults RealtimeSource::faults() const {
  SourceFaults faults = recording_->faults();
  faults.dropped += dropped_;
  return faults;
}

}  // namespace lockbox
