// SPDX-License-Identifier: BSD-3-Clause
// States files: configurations over time as CSV, the format of every trajectory of the project.
//
//   timestamp,tx,ty,tz,qx,qy,qz,qw,<one column a joint>[,<further columns>...]
//
// Seconds, metres, radians; numbers in the C locale; `nan` where nothing is known.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lockbox/model/configuration.hpp"

namespace lockbox {

/// One row of a states file.
struct State {
  double stamp = 0.0;              ///< seconds
  Configuration configuration;     ///< NaN where the file says nan
  std::string status;              ///< of the column `status`, if there is one
  bool known = true;               ///< false where the pose columns are nan
  std::vector<std::string> extra;  ///< fields of the columns that are not pose, joint or status
};

/// All rows of a states file, and the names of its further columns.
struct StatesFile {
  std::vector<std::string> extra_columns;  ///< names, in the order of the file
  std::vector<State> states;               ///< in the order of the file
};

/// Columns may stand in any order; those of the pose and of the joints that mimic no other are
/// needed. Quaternions are normalised, and refused if their norm is off by more than 0.01.
/// Throws InputError with file, line and column.
StatesFile read_states(const std::filesystem::path& file, const KinematicTree& tree);

/// Returns the header line up to the last joint column, without line end.
std::string states_header(const KinematicTree& tree);

/// Returns one row up to the last joint column, without line end, with round-trip precision.
std::string states_row(const KinematicTree& tree, double stamp, const Configuration& configuration);

/// Writes a whole file without further columns.
void write_states(const std::filesystem::path& file, const KinematicTree& tree,
                  const std::vector<State>& states);

}  // namespace lockbox
