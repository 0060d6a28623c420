// SPDX-License-Identifier: BSD-3-Clause
#include "steady_stamps.hpp"

#include <algorithm>
#include <cmath>

#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

constexpr double kShortest = 1e-6;  // seconds: the resolution of OpenNI2's stamps
constexpr double kLongest = 1.0;    // seconds: more is a pause, not a frame period

}  // namespace

bool SteadyStamps::next(DepthFrame& frame) {
  if (!source_->next(frame)) {
    return false;
  }
  learn_period(frame.stamp);
  if (!std::isfinite(frame.stamp) || (last_ && !(frame.stamp > *last_))) {
    advance(frame);
  }
  last_ = frame.stamp;
  return true;
}

SourceFaults SteadyStamps::faults() const {
  SourceFaults faults = source_->faults();
  faults.restamped += advanced_;
  return faults;
}

void SteadyStamps::learn_period(double stamp) {
  if (!std::isfinite(stamp)) {
    return;
  }
  const double step = stamp - original_.value_or(stamp);
  if (step > 0.0 && step <= kLongest) {
    period_ = std::max(step, kShortest);
  }
  original_ = stamp;
}

void SteadyStamps::advance(DepthFrame& frame) {
  if (warn_ && advanced_ == 0) {
    const std::string file = source_->file_of_frame();
    warn_((file.empty() ? "" : file + ": ") + "frame " + std::to_string(frame.index) +
          ": its timestamp " + number_text(frame.stamp) +
          " is not later than that of the frame before; it is advanced, as will others like it");
  }
  ++advanced_;
  frame.stamp = last_ ? *last_ + period_ : 0.0;
}

}  // namespace lockbox
