// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_locator.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <system_error>

#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/text_file.hpp"

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

/// Whether the folder's package.xml gives it that name: clones are often called otherwise.
bool is_package_called(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / "package.xml";
  std::error_code unreadable;
  if (!is_file(file) || fs::file_size(file, unreadable) > kMostWrittenBytes) return false;
  tinyxml2::XMLDocument manifest;
  if (manifest.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) return false;
  const auto* const package = manifest.FirstChildElement("package");
  const auto* const given = package == nullptr ? nullptr : package->FirstChildElement("name");
  return given != nullptr && given->GetText() != nullptr && given->GetText() == name;
}

/// Where the package could be, if folder holds it, or is it.
std::vector<fs::path> package_candidates(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> candidates{folder / name};
  if (folder.filename() == name || is_package_called(folder, name)) candidates.push_back(folder);
  return candidates;
}

std::string listed(const std::vector<fs::path>& folders) {
  std::string text;
  for (const fs::path& folder : folders) text += (text.empty() ? "" : ", ") + folder.string();
  return text;
}

std::vector<fs::path> each_once(const std::vector<fs::path>& folders) {
  std::vector<fs::path> unique;
  for (const fs::path& folder : folders) {
    fs::path whole = fs::absolute(folder).lexically_normal();
    if (whole.filename().empty() && whole.has_relative_path()) whole = whole.parent_path();
    if (std::find(unique.begin(), unique.end(), whole) == unique.end()) unique.push_back(whole);
  }
  return unique;
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
  folders_ = each_once(folders_);
}

fs::path MeshLocator::locate_in_package(const std::string& address,
                                        const fs::path& in_package) const {
  require_within_package(address, in_package);
  const std::string name = in_package.begin()->string();
  const fs::path rest = in_package.lexically_relative(name);
  std::vector<fs::path> packages;
  for (const fs::path& folder : folders_) {
    for (const fs::path& package : package_candidates(folder, name)) {
      if (is_file(package / rest)) return package / rest;
      std::error_code unreadable;
      if (fs::is_directory(package, unreadable)) packages.push_back(package);
    }
  }
  if (!packages.empty()) {
    throw InputError(address, "no such mesh file in the package '" + name + "' (" +
                                  listed(each_once(packages)) +
                                  "); is it another one of that name? Name the folder that holds "
                                  "the right one (--package-path)");
  }
  throw InputError(address, "the package '" + name +
                                "' is missing; name the folder that holds it " +
                                "(--package-path). Searched were " + listed(folders_));
}

fs::path MeshLocator::locate(const std::string& address) const {
  const auto in_package = without_prefix(address, "package://");
  const fs::path path =
      in_package ? *in_package : without_prefix(address, "file://").value_or(address);
  if (path.empty()) throw InputError(address, "names no file");
  if (path.string().find("://") != std::string::npos) {
    throw InputError(address, "only file:// and package:// addresses are read");
  }
  if (in_package) return locate_in_package(address, path);
  if (path.is_absolute()) {
    if (is_file(path)) return path;
    throw InputError(path.string(), "no such mesh file");
  }
  for (const fs::path& folder : folders_) {
    if (is_file(folder / path)) return folder / path;
  }
  throw InputError(address, "no such mesh file in " + listed(folders_) +
                                "; name the folder that holds it (--package-path)");
}

}  // namespace lockbox
