// SPDX-License-Identifier: BSD-3-Clause
// Frames whose stamps increase, whatever their source says.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "lockbox/capture/frame_source.hpp"

namespace lockbox {

/// Passes all frames on. A stamp that is not later than the last one, or is no number, is advanced
/// to the last plus the frame period (the last step of the source's stamps that was at most a
/// second; until there is one, 1/30 s; at least 1 us), told once to warn, if it is set, and
/// counted.
class SteadyStamps : public FrameSource {
 public:
  SteadyStamps(std::unique_ptr<FrameSource> source, std::function<void(const std::string&)> warn)
      : source_(std::move(source)), warn_(std::move(warn)) {}

  bool next(DepthFrame& frame) override;
  std::optional<std::size_t> frame_count() const override { return source_->frame_count(); }
  bool is_realtime() const override { return source_->is_realtime(); }
  bool is_unit_stated() const override { return source_->is_unit_stated(); }
  std::string file_of_frame() const override { return source_->file_of_frame(); }
  SourceFaults faults() const override;
  std::string description() const override { return source_->description(); }

 private:
  void learn_period(double stamp);
  void advance(DepthFrame& frame);

  std::unique_ptr<FrameSource> source_;
  std::function<void(const std::string&)> warn_;
  double period_ = 1.0 / 30.0;      ///< seconds
  std::optional<double> original_;  ///< stamp of the last frame that had one
  std::optional<double> last_;      ///< stamp delivered
  std::size_t advanced_ = 0;
};

}  // namespace lockbox
