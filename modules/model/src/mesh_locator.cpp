// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_locator.hpp"

#include <cstdlib>
#include <optional>
#include <sstream>
#include <system_error>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> ros_package_path() {
  std::vector<fs::path> folders;
  const char* value = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream list{value == nullptr ? "" : value};
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

std::optional<std::string> without_prefix(const std::string& text, const std::string& prefix) {
  if (text.rfind(prefix, 0) != 0) return std::nullopt;
  return text.substr(prefix.size());
}

/// Where the file could be if folder holds the package, or is the package.
std::vector<fs::path> package_candidates(const fs::path& folder, const fs::path& in_package) {
  std::vector<fs::path> candidates{folder / in_package};
  const fs::path package = *in_package.begin();
  if (folder.filename() == package) {
    candidates.push_back(folder / in_package.lexically_relative(package));
  }
  return candidates;
}

bool is_file(const fs::path& path) {
  std::error_code error;  // e.g. a folder that may not be entered: not there, as far as we know
  return fs::is_regular_file(path, error);
}

}  // namespace

MeshLocator::MeshLocator(const fs::path& urdf, const std::vector<fs::path>& package_paths)
    : folders_(package_paths) {
  for (fs::path folder = fs::absolute(urdf).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    folders_.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  const auto ros = ros_package_path();
  folders_.insert(folders_.end(), ros.begin(), ros.end());
}

fs::path MeshLocator::locate(const std::string& address) const {
  const auto in_package = without_prefix(address, "package://");
  const fs::path path =
      in_package ? *in_package : without_prefix(address, "file://").value_or(address);
  if (path.empty()) throw InputError(address, "names no file");
  if (path.string().find("://") != std::string::npos) {
    throw InputError(address, "only file:// and package:// addresses are read");
  }
  if (path.is_absolute()) {
    if (is_file(path)) return path;
    throw InputError(path.string(), "no such mesh file");
  }
  std::string searched;
  for (const fs::path& folder : folders_) {
    const auto candidates =
        in_package ? package_candidates(folder, path) : std::vector<fs::path>{folder / path};
    for (const fs::path& candidate : candidates) {
      if (is_file(candidate)) return candidate;
    }
    searched += (searched.empty() ? "" : ", ") + folder.string();
  }
  throw InputError(address, "no such mesh file in " + searched +
                                "; give the folder that holds it as a package path");
}

}  // namespace lockbox
