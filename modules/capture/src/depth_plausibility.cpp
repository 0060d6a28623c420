// SPDX-License-Identifier: BSD-3-Clause
#include "depth_plausibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "lockbox/core/number_text.hpp"

namespace lockbox {
namespace {

constexpr std::size_t kFew = 100;  // measured pixels: too few to speak of a scale

// Metres, of the median of an image. Depth cameras of 16 bits see from 0.1 m to some 10 m, and half
// of an image that shows an object to track is nearer than the room's end. Double: images in
// 1/5000 m that are read as millimetres (1 m as 5 m) pass in silence.
constexpr double kPlausibleNear = 0.1;
constexpr double kPlausibleFar = 6.0;

// Metres: where a proposed scale must bring the median.
constexpr double kUsualNear = 0.25;
constexpr double kUsualFar = 4.0;

constexpr double kReach = 65.535;  // metres that 16 bits hold at 1 mm, the coarsest unit

struct Scale {
  double units_per_metre;
  const char* name;
};
constexpr std::array kImageScales{Scale{1000, "millimetres"},
                                  Scale{5000, "1/5000 m, as in the TUM data sets"},
                                  Scale{10000, "tenths of a millimetre"}};
constexpr std::array kCloudScales{Scale{1000, "millimetres"}, Scale{100, "centimetres"},
                                  Scale{1e6, "micrometres"}};

template <typename Value>
double median(std::vector<Value>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

std::string metres_text(double metres) {
  const double per_metre = metres < 1.0 ? 1e4 : 1e2;
  return fixed_number_text(std::round(metres * per_metre) / per_metre) + " m";
}

/// The first unit in which the median is usual.
template <typename Scales>
std::string advice(const Scales& scales, double median_units) {
  for (const Scale& scale : scales) {
    const double metres = median_units / scale.units_per_metre;
    if (metres >= kUsualNear && metres <= kUsualFar) {
      return std::string("taken for ") + scale.name + " (--depth-scale " +
             fixed_number_text(scale.units_per_metre) + ") they would be at " + metres_text(metres);
    }
  }
  return "--depth-scale is the number of units per metre";
}

}  // namespace

std::optional<std::string> doubtful_depth_scale(const DepthFrame& frame, double units_per_metre,
                                                bool is_given) {
  std::vector<std::uint16_t> measured;
  std::copy_if(frame.depth.begin(), frame.depth.end(), std::back_inserter(measured),
               [](std::uint16_t value) { return value != 0; });
  if (measured.size() < kFew) {
    return std::nullopt;
  }
  const std::string scale = fixed_number_text(units_per_metre) +
                            (units_per_metre == 1.0 ? " unit per metre" : " units per metre");
  const int step = std::accumulate(measured.begin(), measured.end(), 0,
                                   [](int a, std::uint16_t b) { return std::gcd(a, int{b}); });
  if (!is_given && (step == 5 || step == 10)) {
    const double finer = 1000.0 * step;
    return "all depths are multiples of " + std::to_string(step) +
           ", as if millimetres had been multiplied; if so, give --depth-scale " +
           fixed_number_text(finer) + " (the depth scale in force is " + scale + ")";
  }
  const double units = median(measured);
  const double metres = units / units_per_metre;
  if (metres < kPlausibleNear || metres > kPlausibleFar) {
    const std::string advised =
        units < 20.0 ? "images in whole metres are too coarse to track: write millimetres"
                     : advice(kImageScales, units);
    return "half of the depths are " + std::string(metres < kPlausibleNear ? "nearer" : "farther") +
           " than " + metres_text(metres) +
           ", which is implausible for the depth scale in force, " + scale + "; " + advised;
  }
  return std::nullopt;
}

std::optional<CloudScaleDoubt> doubtful_cloud_scale(const OrganizedCloud& cloud,
                                                    double units_per_metre) {
  std::vector<float> measured;
  for (std::size_t i = 2; i < cloud.xyz.size(); i += 3) {
    if (std::isfinite(cloud.xyz[i]) && cloud.xyz[i] > 0.0F) {
      measured.push_back(cloud.xyz[i]);
    }
  }
  if (measured.size() < kFew) {
    return std::nullopt;
  }
  const double metres = median(measured);
  if (metres <= kPlausibleFar) {
    return std::nullopt;
  }
  return CloudScaleDoubt{"half of the points are farther than " + metres_text(metres) +
                             ", which is implausible for depth cameras; " +
                             advice(kCloudScales, metres * units_per_metre),
                         metres > kReach};
}

}  // namespace lockbox
