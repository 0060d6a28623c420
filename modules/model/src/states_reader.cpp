// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "foreign_states.hpp"
#include "lockbox/core/csv_file.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/readable_text.hpp"
#include "lockbox/model/states_file.hpp"
#include "quaternion_tolerance.hpp"
#include "states_columns.hpp"

namespace lockbox {
namespace {

/// Where each value of a row stands.
struct Columns {
  std::array<std::size_t, kPoseColumns.size()> pose{};
  std::vector<std::pair<int, std::size_t>> joints;  ///< joint, column
  std::vector<std::size_t> status;                  ///< one at most
  std::vector<std::size_t> extra;
};

using ColumnByName = std::map<std::string, std::size_t>;

std::size_t required_column(const CsvFile& csv, const ColumnByName& by_name,
                            const std::string& name, const std::string& meaning) {
  const auto found = by_name.find(name);
  if (found == by_name.end()) {
    csv.refuse_header("the column '" + name + "' (" + meaning + ") is missing");
  }
  return found->second;
}

Columns read_header(const CsvFile& csv, const KinematicTree& tree) {
  Columns columns;
  ColumnByName left;  // columns whose meaning is not known yet
  for (std::size_t column = 0; column < csv.columns().size(); ++column) {
    const std::string_view name = csv.columns()[column];
    if (name.empty()) {
      csv.refuse_header("column " + std::to_string(column + 1) + " has no name");
    }
    if (!left.emplace(name, column).second) {
      csv.refuse_header("the column " + in_quotes(name) + " stands there twice");
    }
  }
  for (std::size_t i = 0; i < kPoseColumns.size(); ++i) {
    const std::string name{kPoseColumns[i]};
    columns.pose[i] = required_column(csv, left, name, "time and pose of the base");
    left.erase(name);
  }
  for (const int joint : tree.file_order) {
    const Joint& described = tree.joints[static_cast<std::size_t>(joint)];
    if (described.is_mimic && left.count(described.name) == 0) continue;
    const auto column = required_column(csv, left, described.name, "a joint of the model");
    columns.joints.emplace_back(joint, column);
    left.erase(described.name);
  }
  for (const auto& [name, column] : left) {
    (name == kStatusColumn ? columns.status : columns.extra).push_back(column);
  }
  std::sort(columns.extra.begin(), columns.extra.end());
  return columns;
}

double value_of(const CsvRow& row, std::size_t column) {
  const auto value = parse_number(row.field(column));
  if (!value || std::isinf(*value)) {
    row.refuse(column, in_quotes(row.field(column)) + " is neither a finite number nor nan");
  }
  return *value;
}

void read_pose(const CsvRow& row, const Columns& columns, State& state) {
  std::array<double, kPoseColumns.size()> pose{};
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = value_of(row, columns.pose[i]);
  if (std::isnan(pose[0])) row.refuse(columns.pose[0], "every row needs a time");
  state.stamp = pose[0];
  const auto unknown =
      std::count_if(pose.begin() + 1, pose.end(), [](double v) { return std::isnan(v); });
  state.known = unknown == 0;
  if (unknown == kPoseColumns.size() - 1) return;
  if (unknown != 0) row.refuse(columns.pose[1], "a pose must be known or nan as a whole");
  Eigen::Quaterniond rotation(pose[7], pose[4], pose[5], pose[6]);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionTolerance)) {
    row.refuse(columns.pose[4], "the quaternion (qx, qy, qz, qw) has norm " +
                                    readable_number(rotation.norm()) + ", not 1");
  }
  state.configuration.T_camera_base =
      Eigen::Translation3d(pose[1], pose[2], pose[3]) * rotation.normalized();
}

State read_row(const CsvRow& row, const Columns& columns, const KinematicTree& tree) {
  State state;
  state.configuration = unknown_configuration(tree);
  read_pose(row, columns, state);
  for (const auto& [joint, column] : columns.joints) {
    const double position = value_of(row, column);
    const Joint& described = tree.joints[static_cast<std::size_t>(joint)];
    if (!described.is_mimic) state.configuration.q[described.variable] = position;
  }
  for (const std::size_t column : columns.status) state.status = row.field(column);
  for (const std::size_t column : columns.extra) state.extra.emplace_back(row.field(column));
  return state;
}

}  // namespace

StatesFile read_states(const std::filesystem::path& file, const KinematicTree& tree) {
  CsvFile csv(file);
  if (!csv.column(kPoseColumns.front())) {
    if (const auto foreign = foreign_states(file, csv.lines())) {
      throw InputError(csv.name(), *foreign);
    }
  }
  const Columns columns = read_header(csv, tree);
  StatesFile result;
  for (const std::size_t column : columns.extra) {
    result.extra_columns.emplace_back(csv.columns()[column]);
  }
  for (CsvRow row; csv.next(row);) result.states.push_back(read_row(row, columns, tree));
  return result;
}

}  // namespace lockbox
