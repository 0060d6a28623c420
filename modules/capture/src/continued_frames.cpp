// SPDX-License-Identifier: BSD-3-Clause
#include "continued_frames.hpp"

namespace lockbox {

void ContinuedFrames::begin(int device_index, Clock::time_point arrival, double stamp) {
  first_index_ = device_index;
  if (!last_) return;
  begin_ = last_->index + 1;
  const double away = std::chrono::duration<double>(arrival - last_->arrival).count();
  shift_ = stamp > last_->stamp ? 0.0 : last_->stamp + away - stamp;
}

void ContinuedFrames::add(int device_index, Clock::time_point arrival, DepthFrame& frame) {
  if (!first_index_) begin(device_index, arrival, frame.stamp);
  frame.index = begin_ + static_cast<std::uint64_t>(device_index - *first_index_);
  frame.stamp += shift_;
  if (last_ && frame.index > last_->index) dropped_ += frame.index - last_->index - 1;
  last_ = {frame.index, frame.stamp, arrival};
}

}  // namespace lockbox
