// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/model/states_file.hpp"
#include "lockbox/model/told_rotation.hpp"
#include "states_columns.hpp"

namespace lockbox {

std::string states_header(const KinematicTree& tree) {
  std::string header;
  for (const std::string_view column : kPoseColumns) {
    header.append(header.empty() ? "" : ",").append(column);
  }
  for (const int joint : tree.file_order) {
    header += "," + tree.joints[static_cast<std::size_t>(joint)].name;
  }
  return header;
}

std::string states_row(const KinematicTree& tree, double stamp,
                       const Configuration& configuration) {
  const Eigen::Vector3d t = configuration.T_camera_base.translation();
  const Eigen::Quaterniond rotation = told_rotation(configuration.T_camera_base);
  std::string row = number_text(stamp);
  for (const double value :
       {t.x(), t.y(), t.z(), rotation.x(), rotation.y(), rotation.z(), rotation.w()}) {
    row.append(",").append(number_text(value));
  }
  for (const int joint : tree.file_order) {
    row.append(",").append(number_text(joint_position(tree, configuration, joint)));
  }
  return row;
}

void write_states(const std::filesystem::path& file, const KinematicTree& tree,
                  const std::vector<State>& states) {
  std::ofstream stream(file, std::ios::binary);
  stream << states_header(tree) << '\n';
  const Configuration unknown = unknown_configuration(tree);
  for (const State& state : states) {
    stream << states_row(tree, state.stamp, state.known ? state.configuration : unknown) << '\n';
  }
  stream.close();
  if (!stream)
    throw InputError(file.string(), "cannot be written; is the folder there, and space?");
}

}  // namespace lockbox
