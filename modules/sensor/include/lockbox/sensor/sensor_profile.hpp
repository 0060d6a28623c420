// SPDX-License-Identifier: BSD-3-Clause
// All that is known of a depth sensor, from a YAML file (docs/sensors.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/sensor/depth_correction.hpp"
#include "lockbox/sensor/sensor_model.hpp"
#include "lockbox/sensor/sensor_noise.hpp"

namespace lockbox {

/// All that is known of a depth sensor.
struct SensorProfile {
  std::string name;            ///< the stem of its file
  std::filesystem::path file;  ///< where it was read from
  std::string description;     ///< one line for people
  SensorNoise noise;           ///< what an estimate from its images assumes
  double min_range = 0.2;      ///< metres; what is measured nearer or farther is no measurement
  double max_range = 5.0;      ///< metres
  /// What turns measured depths into those that are there; none if they are believed.
  std::optional<DepthCorrection> depth_correction;
  /// How the simulator makes its images, with the ranges above; none if the file does not say.
  std::optional<SensorModel> simulated;
};

/// Throws InputError that names file, line, key and what may stand there.
SensorProfile read_sensor_profile(const std::filesystem::path& file);

/// Returns the profile in that file if it exists, else the shipped one of that name: `primesense`
/// stands for share/lockbox/sensors/primesense.yaml. Throws InputError that lists the shipped ones.
SensorProfile find_sensor_profile(const std::string& name_or_file);

/// Returns the names of the shipped profiles, in alphabetical order; none if they are not
/// installed.
std::vector<std::string> shipped_sensor_names();

/// Returns the same names as a sentence has them: `a, b or c`.
std::string sensor_names();

}  // namespace lockbox
