// SPDX-License-Identifier: BSD-3-Clause
#include "realtime_source.hpp"

#include <thread>
#include <utility>

namespace lockbox {

RealtimeSource::RealtimeSource(std::unique_ptr<FrameSource> recording)
    : recording_(std::move(recording)) {}

RealtimeSource::Clock::time_point RealtimeSource::due(const DepthFrame& frame) const {
  return start_ + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(frame.stamp - first_stamp_));
}

bool RealtimeSource::next(DepthFrame& frame) {
  if (!started_) {
    started_ = true;
    has_pending_ = recording_->next(pending_);
    start_ = Clock::now();
    first_stamp_ = pending_.stamp;
  }
  if (!has_pending_) {
    return false;
  }
  std::this_thread::sleep_until(due(pending_));
  do {
    std::swap(frame, pending_);
    has_pending_ = recording_->next(pending_);
  } while (has_pending_ && due(pending_) <= Clock::now());
  return true;
}

}  // namespace lockbox
