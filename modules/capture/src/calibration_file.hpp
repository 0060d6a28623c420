// SPDX-License-Identifier: BSD-3-Clause
// A camera calibration as YAML, in the dialects that there are of it.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox {

/// Finds entries by any of their names, and complains about them by name and line. The names are
/// those of camera_calibration (ROS) and OpenCV (`image_width`, `camera_matrix`), and those of the
/// message sensor_msgs/CameraInfo as `rostopic echo` (`width`, `K`) and `ros2 topic echo` (`k`)
/// print it. Of several documents the first counts. All functions throw InputError.
class CalibrationFile {
 public:
  explicit CalibrationFile(const std::filesystem::path& file);

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& problem) const;

  /// The entry under the first of these names that is there and not empty; else not defined.
  YAML::Node find(const std::vector<const char*>& names) const;

  /// The same, refused under the first name if it is missing.
  YAML::Node entry(const std::vector<const char*>& names) const;

  double number(const YAML::Node& node, const std::string& name) const;

  /// A whole number from minimum to 16384.
  int pixels(const YAML::Node& node, const std::string& name, int minimum) const;

  /// The list of an entry, or the list `data` in it.
  std::vector<double> numbers(const YAML::Node& node, const std::string& name) const;

 private:
  std::string file_;
  YAML::Node root_;
};

}  // namespace lockbox
