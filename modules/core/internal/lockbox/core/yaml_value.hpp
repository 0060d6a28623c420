// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of YAML: whatever is not as it should be is refused with file and line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lockbox {

/// A value, and where it stands. Maps whose keys are known beforehand are read by YamlMap.
class YamlValue {
 public:
  /// The content of a file. kind: what it should be, as a sentence has it. Throws InputError.
  static YamlValue load(const std::filesystem::path& file, const std::string& kind);

  bool is_empty() const { return node_.IsNull(); }

  /// Keys and values; refuses what is no map, keys that are no text, and keys that come twice.
  std::vector<std::pair<YamlValue, YamlValue>> entries() const;

  /// Refuses what is no list, or not of that length.
  std::vector<YamlValue> items(std::size_t count) const;
  std::vector<YamlValue> items() const;

  std::string text() const;
  double number() const;  ///< finite

  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  friend class YamlMap;
  YamlValue(std::string file, const YAML::Node& node) : file_(std::move(file)), node_(node) {}

  std::string file_;
  YAML::Node node_;
};

}  // namespace lockbox
