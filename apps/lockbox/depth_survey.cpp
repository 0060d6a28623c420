// SPDX-License-Identifier: BSD-3-Clause
#include "depth_survey.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numeric>
#include <sstream>

namespace lockbox::app {
namespace {

// Metres. What depth cameras measure nearest: PrimeSense 0.4, RealSense 0.1 to 0.3. Twice as much
// would call close views of small objects a wrong scale.
constexpr double kNearestMeasured = 0.1;

// Of all pixels. Objects that are found cover several per cent of the image. Twice as much would
// blame images of dark rooms in which the object is measured well.
constexpr double kFewPixels = 0.05;

constexpr double kStrays = 0.01;  // of the pixels with a depth, at either end, are no range
constexpr double kMost = 0.5;     // of them lie beyond the range: that is what is wrong first

std::string percent(double share) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(share < 0.1 ? 1 : 0) << 100.0 * share << " %";
  return text.str();
}

std::string metres(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

}  // namespace

void DepthSurvey::add(const DepthFrame& frame) {
  metres_per_unit_ = frame.metres_per_unit;
  pixels_ += frame.depth.size();
  for (const auto depth : frame.depth) ++pixels_of_[depth];
}

std::size_t DepthSurvey::measured_pixels() const {
  return pixels_ - pixels_of_[0];
}

double DepthSurvey::quantile(double share) const {
  const double wanted = share * static_cast<double>(measured_pixels());
  std::size_t below = 0;
  for (std::size_t depth = 1; depth < kDepths; ++depth) {
    below += pixels_of_[depth];
    if (static_cast<double>(below) >= wanted && below > 0) {
      return static_cast<double>(depth) * metres_per_unit_;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double DepthSurvey::share_beyond() const {
  const auto last = static_cast<std::ptrdiff_t>(
      std::min(max_depth_ / metres_per_unit_, static_cast<double>(kDepths - 1)));
  const std::size_t beyond =
      std::accumulate(pixels_of_.begin() + last + 1, pixels_of_.end(), std::size_t{0});
  return static_cast<double>(beyond) / static_cast<double>(measured_pixels());
}

std::string DepthSurvey::findings() const {
  if (measured_pixels() == 0) {
    return "no pixel has a depth; is the camera covered, or are these no depth images?";
  }
  const double measured = static_cast<double>(measured_pixels()) / static_cast<double>(pixels_);
  const double nearest = quantile(kStrays);
  const double farthest = quantile(1.0 - kStrays);
  const std::string scale =
      std::string("is the depth scale right (--depth-scale, units per metre; ")
          .append("here a unit is ")
          .append(metres(1000.0 * metres_per_unit_))
          .append(" mm)?");
  std::string text = percent(measured) + " of the pixels have a depth, " + metres(nearest) +
                     " to " + metres(farthest) + " m";
  if (share_beyond() > kMost) {
    text += "; " + percent(share_beyond()) + " of that is beyond the tracker's " +
            metres(max_depth_) + " m: " + scale;
  } else if (farthest < kNearestMeasured) {
    text += ", nearer than depth cameras measure: " + scale;
  } else if (measured < kFewPixels) {
    text += "; that is little: does the camera see the object, and from far enough?";
  }
  return text;
}

}  // namespace lockbox::app
