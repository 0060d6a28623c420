// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_report.hpp"

#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

namespace lockbox::app {
namespace {

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

}  // namespace

SensorReport::SensorReport(const Tracker& tracker, bool quiet)
    : assumed_(tracker.options().registration.noise), is_said_(quiet) {}

void SensorReport::look_at(const Tracker& tracker) {
  if (is_said_ || tracker.options().registration.noise == assumed_) return;
  std::cerr << "sensor: noise " << noise_text(tracker.options().registration.noise) << '\n';
  is_said_ = true;
}

}  // namespace lockbox::app
