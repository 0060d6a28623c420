// SPDX-License-Identifier: BSD-3-Clause
// A recording that behaves like a live device.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Delivers frames when their stamps are due, counted from the first call of next(). A consumer
/// that is late gets the newest frame that is due; the ones before it are dropped.
class RealtimeSource : public FrameSource {
 public:
  /// While it waits it asks, if stop is given, whether to go on; it ends when that returns true.
  explicit RealtimeSource(std::unique_ptr<FrameSource> recording, std::function<bool()> stop = {});

  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override { return recording_->frame_count(); }
  bool is_realtime() const override { return true; }
  bool is_unit_stated() const override { return recording_->is_unit_stated(); }
  std::string file_of_frame() const override { return file_; }
  SourceFaults faults() const override;
  std::string description() const override { return recording_->description() + ", in real time"; }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point due(const DepthFrame& frame) const;
  bool wait_until(Clock::time_point time) const;
  void take_pending(DepthFrame& frame);

  std::unique_ptr<FrameSource> recording_;
  std::function<bool()> stop_;
  DepthFrame pending_;  ///< read, not yet delivered
  std::string file_;    ///< of the frame delivered last
  bool started_ = false;
  bool has_pending_ = false;
  std::size_t dropped_ = 0;
  Clock::time_point start_;
  double first_stamp_ = 0.0;
};

}  // namespace lockbox
