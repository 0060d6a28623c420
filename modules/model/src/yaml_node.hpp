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

class YamlNode {
 public:
  /// The top of a file's only document. Throws InputError if it is not YAML.
  static YamlNode read(const std::filesystem::path& file);

  bool is_empty() const { return node_.IsNull(); }

  /// Keys and values; refuses what is no map, keys that are no text, and keys that come twice.
  std::vector<std::pair<std::string, YamlNode>> entries() const;

  /// Refuses what is no list, or not of that length.
  std::vector<YamlNode> items(std::size_t count) const;
  std::vector<YamlNode> items() const;

  std::string text() const;
  double number() const;  ///< finite

  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  YamlNode(std::string file, const YAML::Node& node) : file_(std::move(file)), node_(node) {}

  std::string file_;
  YAML::Node node_;
};

}  // namespace lockbox
