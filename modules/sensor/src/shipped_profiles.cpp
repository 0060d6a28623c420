// SPDX-License-Identifier: BSD-3-Clause
#include "shipped_profiles.hpp"

#include <algorithm>
#include <vector>

#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/sensor/sensor_profile.hpp"

namespace lockbox {
namespace {

namespace fs = std::filesystem;

constexpr auto kExtension = ".yaml";

/// Returns the folder of the installation or build tree that this library is part of.
fs::path profiles_folder() {
  return share_folder(&kExtension) / "sensors";
}

bool is_name(const std::string& text) {
  return !text.empty() && text.find_first_of("/.") == std::string::npos;
}

}  // namespace

std::optional<fs::path> shipped_profile(const std::string& name) {
  const fs::path file = profiles_folder() / (name + kExtension);
  return is_name(name) && is_file(file) ? std::optional(file) : std::nullopt;
}

std::vector<std::string> shipped_sensor_names() {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(profiles_folder(), unreadable)) {
    if (entry.path().extension() == kExtension) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string sensor_names() {
  const std::vector<std::string> names = shipped_sensor_names();
  std::string sentence;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_last = i + 1 == names.size();
    sentence.append(i == 0 ? "" : is_last ? " or " : ", ").append(names[i]);
  }
  return sentence;
}

SensorProfile find_sensor_profile(const std::string& name_or_file) {
  if (is_file(name_or_file)) return read_sensor_profile(name_or_file);
  if (const auto shipped = shipped_profile(name_or_file)) return read_sensor_profile(*shipped);
  throw InputError("sensor '" + name_or_file + "'",
                   with_documents("there is no such profile; choose " + sensor_names() +
                                      ", or give a file (docs/sensors.md says what it holds)",
                                  &kExtension));
}

}  // namespace lockbox
