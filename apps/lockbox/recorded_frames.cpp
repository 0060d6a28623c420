// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_frames.hpp"

#include <utility>

#include "lockbox/core/error.hpp"

namespace lockbox::app {
namespace {

constexpr std::size_t kKept = 256;  // 150 MB of 640x480

}  // namespace

RecordedFrames::RecordedFrames(std::unique_ptr<FrameSource> source, Open reopen)
    : source_(std::move(source)),
      reopen_(std::move(reopen)),
      size_(source_->frame_count().value_or(0)) {
  if (at(0) == nullptr) throw InputError(source_->description(), "delivered no frame");
}

const DepthFrame* RecordedFrames::at(std::size_t index) {
  if (index + kept_.size() < read_) {
    source_.reset();  // some devices are opened only once
    source_ = reopen_();
    read_ = 0;
    ended_ = false;
    kept_.clear();
  }
  while (read_ <= index && !ended_) read_next();
  return index < read_ ? &kept_[index + kept_.size() - read_] : nullptr;
}

void RecordedFrames::read_next() {
  DepthFrame frame;
  if (kept_.size() == kKept) {
    frame = std::move(kept_.front());  // its buffer is used again
    kept_.pop_front();
  }
  if (source_->next(frame)) {
    kept_.push_back(std::move(frame));
    ++read_;
  } else {
    ended_ = true;
    size_ = read_;
  }
}

}  // namespace lockbox::app
