// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of YAML: whatever is not as it should be is refused with file and line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lockbox {

/// A value, and where it stands. Maps whose keys are known beforehand are read by YamlMap.
class YamlValue {
 public:
  /// The content of a file. kind: what it should be, as a sentence has it. Throws InputError.
  static YamlValue load(const std::filesystem::path& file, const std::string& kind);

  /// The first document of a text that was read from a file. Throws InputError.
  static YamlValue parse(const std::string& file, const std::string& text);

  bool is_empty() const { return node_.IsNull(); }
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_plain() const { return node_.IsScalar(); }

  /// The value of a key; nothing if it is not there or empty, or if this is no map. For files of
  /// others, whose further keys are none of our business.
  std::optional<YamlValue> find(const std::string& key) const;

  /// The keys that are text, however often they come; none if this is no map. For files that may be
  /// of others, too.
  std::vector<std::string> plain_keys() const;

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
