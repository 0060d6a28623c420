// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_locator.hpp"

#include <tinyxml2.h>

#include <cstdlib>
#include <optional>
#include <sstream>
#include <system_error>

#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

namespace fs = std::filesystem;

/// Appends the folders that the environment variable lists, with `below` behind each.
void append_listed(const char* variable, const fs::path& below, std::vector<fs::path>& folders) {
  const char* value = std::getenv(variable);
  std::istringstream list{value == nullptr ? "" : value};
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.push_back(below.empty() ? fs::path(folder) : folder / below);
  }
}

std::optional<std::string> without_prefix(const std::string& text, const std::string& prefix) {
  if (text.rfind(prefix, 0) != 0) return std::nullopt;
  return text.substr(prefix.size());
}

bool is_file(const fs::path& path) {
  std::error_code error;  // e.g. a folder that may not be entered: not there, as far as we know
  return fs::is_regular_file(path, error);
}

/// Whether the folder's package.xml gives it that name: clones are often called otherwise.
bool is_package_called(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / "package.xml";
  tinyxml2::XMLDocument manifest;
  if (!is_file(file) || manifest.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* const package = manifest.FirstChildElement("package");
  const auto* const given = package == nullptr ? nullptr : package->FirstChildElement("name");
  return given != nullptr && given->GetText() != nullptr && given->GetText() == name;
}

/// Where the file could be if folder holds the package, or is the package.
std::vector<fs::path> package_candidates(const fs::path& folder, const fs::path& in_package) {
  std::vector<fs::path> candidates{folder / in_package};
  const fs::path package = *in_package.begin();
  if (folder.filename() == package || is_package_called(folder, package.string())) {
    candidates.push_back(folder / in_package.lexically_relative(package));
  }
  return candidates;
}

/// Symbolic links may lead anywhere: who made them has access to the machine, a URDF may come from
/// anybody.
void require_within_package(const std::string& address, const fs::path& in_package) {
  int depth = 0;
  for (const fs::path& part : in_package) {
    if (part == "." || part.empty()) continue;
    depth += part == ".." ? -1 : 1;
    if (depth < 1) break;
  }
  if (depth < 1 || in_package.is_absolute() || *in_package.begin() == ".") {
    throw InputError(address,
                     "leaves its package: package:// is followed by the name of a package "
                     "and a path in it, without leading out by '..'");
  }
}

}  // namespace

MeshLocator::MeshLocator(const fs::path& urdf, const std::vector<fs::path>& package_paths)
    : folders_(package_paths) {
  for (fs::path folder = fs::absolute(urdf).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    folders_.push_back(folder);
    if (folder == folder.parent_path()) break;
  }
  append_listed("ROS_PACKAGE_PATH", "", folders_);
  for (const char* prefixes : {"AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"}) {
    append_listed(prefixes, "share", folders_);
  }
}

fs::path MeshLocator::locate(const std::string& address) const {
  const auto in_package = without_prefix(address, "package://");
  const fs::path path =
      in_package ? *in_package : without_prefix(address, "file://").value_or(address);
  if (path.empty()) throw InputError(address, "names no file");
  if (path.string().find("://") != std::string::npos) {
    throw InputError(address, "only file:// and package:// addresses are read");
  }
  if (in_package) require_within_package(address, path);
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
                                "; name the folder that holds it (--package-path)");
}

}  // namespace lockbox
