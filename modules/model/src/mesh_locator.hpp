// SPDX-License-Identifier: BSD-3-Clause
// Finds the mesh files that a URDF names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lockbox {

/// Resolves absolute and relative names, file:// and package:// addresses. Searched in this order:
/// the package paths given, beside the URDF, the folders above it, ROS_PACKAGE_PATH, and the folder
/// `share` of each prefix that AMENT_PREFIX_PATH, COLCON_PREFIX_PATH or CMAKE_PREFIX_PATH name.
class MeshLocator {
 public:
  MeshLocator(const std::filesystem::path& urdf,
              const std::vector<std::filesystem::path>& package_paths);

  /// Throws InputError saying where was searched and which package is missing, and for a package://
  /// address that leaves its package.
  std::filesystem::path locate(const std::string& address) const;

 private:
  /// in_package: the address without `package://`.
  std::filesystem::path locate_in_package(const std::string& address,
                                          const std::filesystem::path& in_package) const;

  std::vector<std::filesystem::path> folders_;  ///< absolute, each once
};

}  // namespace lockbox
