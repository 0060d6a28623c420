// SPDX-License-Identifier: BSD-3-Clause
#include "estimated_sensor.hpp"

#include <iomanip>
#include <iostream>
#include <sstream>

#include "lockbox/sensor/noise_record.hpp"

namespace lockbox::app {
namespace {

constexpr int kFrames = 10;  // a third of a second; those of a source that starts may be empty

}  // namespace

std::optional<SensorNoise> noise_of_first_frames(FrameSource& source) {
  DepthFrame frame;
  for (int i = 0; i < kFrames && source.next(frame); ++i) {
    if (const auto noise = estimate_noise(frame)) return noise;
  }
  std::cerr << "lockbox: warning: the first frames show too little to tell the sensor's noise "
               "(--sensor auto); it is taken for a primesense until others do\n";
  return std::nullopt;
}

std::string noise_text(const SensorNoise& noise) {
  constexpr double kMillimetres = 1000.0;
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << kMillimetres * noise.depth_floor << " mm + "
       << kMillimetres * noise.depth_quadratic << " mm z^2 (z in metres), of which each pixel errs "
       << std::setprecision(0) << 100.0 * noise.own_share
       << " % by itself, and the rest alike over " << std::setprecision(1)
       << noise.correlation_pixels << " pixels";
  return text.str();
}

}  // namespace lockbox::app
