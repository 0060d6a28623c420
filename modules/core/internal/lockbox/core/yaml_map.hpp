// SPDX-License-Identifier: BSD-3-Clause
// A YAML map whose every key must be known and whose every value must fit, or else an InputError
// with file and line.
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace lockbox {

/// The content of a file. kind: what it should be, as a sentence has it. Throws InputError.
YAML::Node load_yaml(const std::filesystem::path& file, const std::string& kind);

/// A number from lowest to highest, or else what it must be, as a sentence has it.
struct NumberRange {
  double lowest;
  double highest;
  const char* demand;
};

class YamlMap {
 public:
  /// Refuses what is no map, and keys that are not among the known ones or come twice.
  YamlMap(const std::string& file, const YAML::Node& node,
          std::initializer_list<const char*> known_keys);

  bool has(const char* key) const { return node_[key].IsDefined(); }

  /// The values below leave the target as it is where the key is absent.
  void read(const char* key, std::string& value) const;
  void read(const char* key, double& value) const;
  void read(const char* key, const NumberRange& range, double& value) const;
  /// `true` or `false`.
  void read(const char* key, bool& value) const;
  void read(const char* key, std::vector<std::string>& words) const;
  template <int Size>
  void read(const char* key, Eigen::Matrix<double, Size, 1>& value) const {
    if (has(key)) {
      const std::vector<double> numbers = read_list(key, Size);
      value = Eigen::Map<const Eigen::Matrix<double, Size, 1>>(numbers.data());
    }
  }

  YAML::Node node(const char* key) const { return node_[key]; }

  /// The entries of a list; none where the key is absent.
  std::vector<YAML::Node> items(const char* key) const;

  void require(const char* key) const;
  [[noreturn]] void refuse(const char* key, const std::string& problem) const;

 private:
  double number(const char* key, const YAML::Node& node) const;
  std::vector<double> read_list(const char* key, std::size_t size) const;

  std::string file_;
  YAML::Node node_;
};

}  // namespace lockbox
