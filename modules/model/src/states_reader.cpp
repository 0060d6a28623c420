// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "foreign_states.hpp"
#include "lockbox/core/csv_fields.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/core/text_file.hpp"
#include "lockbox/model/states_file.hpp"
#include "quaternion_tolerance.hpp"
#include "states_columns.hpp"

namespace lockbox {
namespace {

/// Where each value of a row stands.
struct Columns {
  std::vector<std::string> names;
  std::array<std::size_t, kPoseColumns.size()> pose{};
  std::vector<std::pair<int, std::size_t>> joints;  ///< joint, column
  std::vector<std::size_t> status;                  ///< one at most
  std::vector<std::size_t> extra;
};

/// One line of the file, and how to complain about it.
struct Row {
  const std::string& file;
  int line;
  const Columns& columns;
  std::vector<std::string_view> fields;

  [[noreturn]] void refuse(std::size_t column, const std::string& problem) const {
    throw InputError(file, line, "column '" + columns.names[column] + "': " + problem);
  }

  double number(std::size_t column) const {
    const auto value = parse_number(fields[column]);
    if (!value || std::isinf(*value)) {
      refuse(column, in_quotes(fields[column]) + " is neither a finite number nor nan");
    }
    return *value;
  }
};

using ColumnByName = std::map<std::string, std::size_t>;

std::size_t required_column(const std::string& file, const ColumnByName& by_name,
                            const std::string& name, const std::string& meaning) {
  const auto found = by_name.find(name);
  if (found == by_name.end()) {
    throw InputError(file, 1, "the column '" + name + "' (" + meaning + ") is missing");
  }
  return found->second;
}

Columns read_header(const std::string& file, std::string_view line, const KinematicTree& tree) {
  Columns columns;
  ColumnByName left;  // columns whose meaning is not known yet
  for (const std::string_view name : split_fields(line)) {
    const std::size_t column = columns.names.size();
    columns.names.emplace_back(name);
    if (name.empty()) {
      throw InputError(file, 1, "column " + std::to_string(column + 1) + " has no name");
    }
    if (!left.emplace(name, column).second) {
      throw InputError(file, 1, "the column " + in_quotes(name) + " stands there twice");
    }
  }
  for (std::size_t i = 0; i < kPoseColumns.size(); ++i) {
    const std::string name{kPoseColumns[i]};
    columns.pose[i] = required_column(file, left, name, "time and pose of the base");
    left.erase(name);
  }
  for (const int joint : tree.file_order) {
    const Joint& described = tree.joints[static_cast<std::size_t>(joint)];
    if (described.is_mimic && left.count(described.name) == 0) continue;
    const auto column = required_column(file, left, described.name, "a joint of the model");
    columns.joints.emplace_back(joint, column);
    left.erase(described.name);
  }
  for (const auto& [name, column] : left) {
    (name == kStatusColumn ? columns.status : columns.extra).push_back(column);
  }
  std::sort(columns.extra.begin(), columns.extra.end());
  return columns;
}

void read_pose(const Row& row, State& state) {
  std::array<double, kPoseColumns.size()> pose{};
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = row.number(row.columns.pose[i]);
  if (std::isnan(pose[0])) row.refuse(row.columns.pose[0], "every row needs a time");
  state.stamp = pose[0];
  const auto unknown =
      std::count_if(pose.begin() + 1, pose.end(), [](double v) { return std::isnan(v); });
  state.known = unknown == 0;
  if (unknown == kPoseColumns.size() - 1) return;
  if (unknown != 0) row.refuse(row.columns.pose[1], "a pose must be known or nan as a whole");
  Eigen::Quaterniond rotation(pose[7], pose[4], pose[5], pose[6]);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionTolerance)) {
    row.refuse(row.columns.pose[4], "the quaternion (qx, qy, qz, qw) has norm " +
                                        readable_number(rotation.norm()) + ", not 1");
  }
  state.configuration.T_camera_base =
      Eigen::Translation3d(pose[1], pose[2], pose[3]) * rotation.normalized();
}

State read_row(const Row& row, const KinematicTree& tree) {
  State state;
  state.configuration = unknown_configuration(tree);
  read_pose(row, state);
  for (const auto& [joint, column] : row.columns.joints) {
    const double position = row.number(column);
    const Joint& described = tree.joints[static_cast<std::size_t>(joint)];
    if (!described.is_mimic) state.configuration.q[described.variable] = position;
  }
  for (const std::size_t column : row.columns.status) state.status = row.fields[column];
  for (const std::size_t column : row.columns.extra) state.extra.emplace_back(row.fields[column]);
  return state;
}

}  // namespace

StatesFile read_states(const std::filesystem::path& file, const KinematicTree& tree) {
  const std::string name = file.string();
  const std::string text = read_text_file(file);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view content = text;
  if (content.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    content.remove_prefix(kByteOrderMark.size());
  }
  const auto lines = split_fields(content, '\n');
  const auto names = split_fields(lines.front());
  if (std::find(names.begin(), names.end(), kPoseColumns.front()) == names.end()) {
    if (const auto foreign = foreign_states(file, lines)) throw InputError(name, *foreign);
  }
  const Columns columns = read_header(name, lines.front(), tree);
  StatesFile result;
  for (const std::size_t column : columns.extra) {
    result.extra_columns.push_back(columns.names[column]);
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].empty()) continue;
    const Row row{name, static_cast<int>(i) + 1, columns, split_fields(lines[i])};
    if (row.fields.size() != columns.names.size()) {
      throw InputError(name, row.line,
                       "has " + std::to_string(row.fields.size()) + " fields, the header " +
                           std::to_string(columns.names.size()) + "; is the line cut off?");
    }
    result.states.push_back(read_row(row, tree));
  }
  return result;
}

}  // namespace lockbox
