// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/tum_trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox {
namespace {

constexpr double kNormTolerance = 0.01;  // of quaternions written with few digits

using Pose = std::array<double, 8>;

bool is_comment(const std::string& line) {
  const auto first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

std::optional<Pose> parse_pose(const std::string& line) {
  std::istringstream words(line);
  Pose pose{};
  std::string word;
  for (double& value : pose) {
    if (!(words >> word)) return std::nullopt;
    const auto number = parse_finite_number(word);
    if (!number) return std::nullopt;
    value = *number;
  }
  if (words >> word) return std::nullopt;
  return pose;
}

State state_of(const Pose& pose) {
  State state;
  state.stamp = pose[0];
  const Eigen::Quaterniond rotation(pose[7], pose[4], pose[5], pose[6]);
  state.configuration.T_camera_base =
      Eigen::Translation3d(pose[1], pose[2], pose[3]) * rotation.normalized();
  return state;
}

bool is_rotation(const Pose& pose) {
  const double norm = Eigen::Vector4d(pose[4], pose[5], pose[6], pose[7]).norm();
  return std::abs(norm - 1.0) <= kNormTolerance;
}

}  // namespace

bool is_tum_trajectory(const std::filesystem::path& file) {
  if (!is_file(file)) return false;
  std::istringstream in(read_text_file(file));
  std::string line;
  while (std::getline(in, line)) {
    if (!is_comment(line)) return parse_pose(line).has_value();
  }
  return false;
}

StatesFile read_tum_trajectory(const std::filesystem::path& file) {
  std::istringstream in(read_text_file(file));
  StatesFile result;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (is_comment(text)) continue;
    const auto pose = parse_pose(text);
    if (!pose) {
      throw InputError(file.string(), line,
                       "expected eight numbers: timestamp tx ty tz qx qy qz qw");
    }
    if (!is_rotation(*pose)) {
      throw InputError(file.string(), line, "the quaternion (qx, qy, qz, qw) has not norm 1");
    }
    result.states.push_back(state_of(*pose));
  }
  return result;
}

}  // namespace lockbox
