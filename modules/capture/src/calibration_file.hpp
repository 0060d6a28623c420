// SPDX-License-Identifier: BSD-3-Clause
// A camera calibration as YAML, in the dialects that there are of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/core/yaml_value.hpp"

namespace lockbox {

/// Finds entries by any of their names, and complains about them by name and line. The names are
/// those of camera_calibration (ROS) and OpenCV (`image_width`, `camera_matrix`), and those of the
/// message sensor_msgs/CameraInfo as `rostopic echo` (`width`, `K`) and `ros2 topic echo` (`k`)
/// print it. Of several documents the first counts. All functions throw InputError.
class CalibrationFile {
 public:
  explicit CalibrationFile(const std::filesystem::path& file);

  /// The entry under the first of these names that is there and not empty, if any is.
  std::optional<YamlValue> find(const std::vector<const char*>& names) const;

  /// The same, refused under the first name if it is missing.
  YamlValue entry(const std::vector<const char*>& names) const;

  static double number(const YamlValue& value, const std::string& name);

  /// A whole number from minimum to 16384.
  static int pixels(const YamlValue& value, const std::string& name, int minimum);

  /// The list of an entry, or the list `data` in it.
  static std::vector<double> numbers(const YamlValue& value, const std::string& name);

 private:
  std::string file_;
  YamlValue root_;
};

}  // namespace lockbox
