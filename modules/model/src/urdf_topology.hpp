// SPDX-License-Identifier: BSD-3-Clause
// Checks that links and joints form one tree, before anybody walks along it: urdfdom does not.
#pragma once

#include <string>
#include <vector>

namespace lockbox {

struct UrdfLink {
  std::string name;
  int line = 0;
};

struct UrdfJoint {
  std::string name;
  std::string type;
  std::string parent;
  std::string child;
  std::string mimics;  ///< name of a joint; empty if it mimics none
  int line = 0;
};

/// Throws InputError with file, line and name for duplicate names, links that do not exist, a link
/// with two parents, cycles, more than one root, mimics of joints that do not exist, do not move,
/// or mimic in a circle.
void check_topology(const std::string& file, const std::vector<UrdfLink>& links,
                    const std::vector<UrdfJoint>& joints);

}  // namespace lockbox
