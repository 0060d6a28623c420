// SPDX-License-Identifier: BSD-3-Clause
// A YAML value that is a map whose every key must be known and whose every value must fit, or else
// an InputError with file and line.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <vector>

#include "lockbox/core/yaml_value.hpp"

namespace lockbox {

/// A number from lowest to highest, or else what it must be, as a sentence has it.
struct NumberRange {
  double lowest;
  double highest;
  const char* demand;
};

class YamlMap {
 public:
  /// Refuses what is no map, and keys that are not among the known ones or come twice.
  YamlMap(const YamlValue& map, std::initializer_list<const char*> known_keys);

  bool has(const char* key) const { return map_.node_[key].IsDefined(); }

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

  /// The value of a key that is there.
  YamlValue value(const char* key) const { return {map_.file_, map_.node_[key]}; }

  /// The entries of a list; none where the key is absent.
  std::vector<YamlValue> items(const char* key) const;

  void require(const char* key) const;
  [[noreturn]] void refuse(const char* key, const std::string& problem) const;

 private:
  double number(const char* key, const YamlValue& value) const;
  std::vector<double> read_list(const char* key, std::size_t size) const;

  YamlValue map_;
};

}  // namespace lockbox
