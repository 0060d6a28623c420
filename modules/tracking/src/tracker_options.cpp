// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/tracking/tracker_options.hpp"

#include <algorithm>

#include "lockbox/sensor/sensor_profile.hpp"

namespace lockbox {

void assume_sensor(const SensorProfile& sensor, TrackerOptions& options) {
  options.cloud.min_depth = sensor.min_range;
  options.cloud.max_depth = sensor.max_range;
  assume_noise(sensor.noise, options.registration);
  options.frames_between_noises = 0;
}

void assume_noise(const SensorNoise& noise, RegistrationOptions& registration) {
  registration.noise = noise;
  // Points are chosen and averaged, which leaves of the errors that are alike the same share for
  // any sensor. Of the one that the default stands for, that was found.
  const double alike = noise.correlation_area() / SensorNoise{}.correlation_area();
  registration.noise_correlation = std::max(1.0, RegistrationOptions{}.noise_correlation * alike);
  // Along a contour as far as errors are alike; models' own edges err together, whatever the
  // sensor.
  const double longer = noise.correlation_pixels / SensorNoise{}.correlation_pixels;
  registration.contour_correlation =
      RegistrationOptions{}.contour_correlation * std::max(1.0, longer);
}

}  // namespace lockbox
