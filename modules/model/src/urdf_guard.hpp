// SPDX-License-Identifier: BSD-3-Clause
// The guard in front of urdfdom, which reads past the end of truncated files and lets cycles,
// second parents, zero axes, unknown mimic joints and inverted limits pass.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lockbox {

struct GuardedUrdf {
  /// The robot written anew: only what lockbox understands, every value checked.
  std::string text;
  std::map<std::string, int> link_lines;
  std::map<std::string, int> joint_lines;
  std::vector<std::string> movable_joints;  ///< in the order of the file
  std::vector<std::string> collision_only_links;
  /// Lower and upper limit of mimic joints as far as they can be read.
  std::map<std::string, std::pair<double, double>> mimic_limits;
  /// What is strange, but no reason to refuse the file; with file and line.
  std::vector<std::string> warnings;
};

/// text: content of the file, whose name appears in the errors. Throws InputError.
GuardedUrdf guard_urdf(const std::string& file, const std::string& text);

}  // namespace lockbox
