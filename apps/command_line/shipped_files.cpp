// SPDX-License-Identifier: BSD-3-Clause
#include "shipped_files.hpp"

#include <algorithm>

#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"
#include "nearest_name.hpp"

namespace lockbox::app {
namespace {

namespace fs = std::filesystem;

/// Returns the folder beside that of the program, installed or in a build folder; where other
/// programs have loaded this code (Python), above the folder of its library.
fs::path share_folder() {
  const fs::path beside_program =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share" / "lockbox";
  if (fs::is_directory(beside_program / "models")) return beside_program;
  return lockbox::share_folder(reinterpret_cast<const void*>(&find_model));
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    if (entry.is_directory() || entry.path().extension() == ".yaml") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path find(const std::string& file_or_name, const fs::path& folder, const fs::path& shipped) {
  if (fs::is_regular_file(file_or_name)) return file_or_name;
  const bool is_name = file_or_name.find_first_of("/.") == std::string::npos;
  if (is_name && fs::exists(folder / shipped)) return folder / shipped;
  const std::vector<std::string> names = names_in(folder);
  std::string list;
  for (const auto& name : names) list.append(list.empty() ? "" : ", ").append(name);
  throw InputError(file_or_name, "there is no such file; give a file, or one of the shipped: " +
                                     list + (is_name ? did_you_mean(file_or_name, names) : ""));
}

}  // namespace

fs::path find_model(const std::string& file_or_name) {
  return find(file_or_name, share_folder() / "models",
              fs::path(file_or_name) / (file_or_name + ".urdf"));
}

std::vector<std::string> shipped_models() {
  return names_in(share_folder() / "models");
}

std::vector<std::string> shipped_scenes() {
  return names_in(share_folder() / "scenes");
}

fs::path find_scene(const std::string& file_or_name) {
  return find(file_or_name, share_folder() / "scenes", file_or_name + ".yaml");
}

fs::path shipped_file(const std::string& name) {
  const fs::path file = share_folder() / name;
  if (!fs::is_regular_file(file)) {
    throw InputError(file.string(), "this shipped file is missing; install lockbox completely");
  }
  return file;
}

fs::path shipped_documents() {
  return documents_folder(reinterpret_cast<const void*>(&find_model));
}

}  // namespace lockbox::app
