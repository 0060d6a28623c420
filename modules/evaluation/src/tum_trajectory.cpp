// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/evaluation/tum_trajectory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "lockbox/core/csv_fields.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox {
namespace {

constexpr double kNormTolerance = 0.01;  // of quaternions written with few digits

using Pose = std::array<double, 8>;

/// line: trimmed.
bool is_comment(std::string_view line) {
  return line.empty() || line.front() == '#';
}

std::optional<Pose> parse_pose(std::string_view line) {
  const auto words = split_words(line);
  Pose pose{};
  if (words.size() != pose.size()) return std::nullopt;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const auto number = parse_finite_number(words[i]);
    if (!number) return std::nullopt;
    pose[i] = *number;
  }
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
  const std::string text = read_text_file(file);
  for (const std::string_view line : split_fields(text, '\n')) {
    if (!is_comment(line)) return parse_pose(line).has_value();
  }
  return false;
}

StatesFile read_tum_trajectory(const std::filesystem::path& file) {
  const std::string text = read_text_file(file);
  StatesFile result;
  int line = 0;
  for (const std::string_view row : split_fields(text, '\n')) {
    ++line;
    if (is_comment(row)) continue;
    const auto pose = parse_pose(row);
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
