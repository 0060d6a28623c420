// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/yaml_map.hpp"

#include <algorithm>

#include "lockbox/core/number_text.hpp"

namespace lockbox {

YamlMap::YamlMap(const YamlValue& map, std::initializer_list<const char*> known_keys) : map_(map) {
  for (const auto& [name, value] : map.entries()) {
    const std::string key = name.text();
    if (std::find(known_keys.begin(), known_keys.end(), key) != known_keys.end()) continue;
    std::string choices;
    for (const char* known : known_keys) {
      choices += choices.empty() ? known : std::string(", ") + known;
    }
    name.refuse("unknown key '" + key + "'; known here: " + choices);
  }
}

void YamlMap::read(const char* key, std::string& value) const {
  if (!has(key)) return;
  if (!map_.node_[key].IsScalar()) refuse(key, "must be a word");
  value = map_.node_[key].Scalar();
}

void YamlMap::read(const char* key, double& value) const {
  if (has(key)) value = number(key, this->value(key));
}

void YamlMap::read(const char* key, const NumberRange& range, double& value) const {
  if (!has(key)) return;
  read(key, value);
  if (!(value >= range.lowest && value <= range.highest)) refuse(key, range.demand);
}

void YamlMap::read(const char* key, bool& value) const {
  std::string word = value ? "true" : "false";
  read(key, word);
  if (word != "true" && word != "false") refuse(key, "must be true or false");
  value = word == "true";
}

void YamlMap::read(const char* key, std::vector<std::string>& words) const {
  for (const YamlValue& item : items(key)) {
    if (!item.node_.IsScalar()) refuse(key, "must be a list of words");
    words.push_back(item.text());
  }
}

std::vector<YamlValue> YamlMap::items(const char* key) const {
  if (!has(key)) return {};
  if (!map_.node_[key].IsSequence()) refuse(key, "must be a list");
  return value(key).items();
}

void YamlMap::require(const char* key) const {
  if (!has(key)) map_.refuse("the key '" + std::string(key) + "' is missing");
}

void YamlMap::refuse(const char* key, const std::string& problem) const {
  (has(key) ? value(key) : map_).refuse("'" + std::string(key) + "' " + problem);
}

double YamlMap::number(const char* key, const YamlValue& value) const {
  const auto number = parse_finite_number(value.node_.IsScalar() ? value.text() : "");
  if (!number) refuse(key, "needs finite numbers");
  return *number;
}

std::vector<double> YamlMap::read_list(const char* key, std::size_t size) const {
  const std::vector<YamlValue> entries = items(key);
  if (entries.size() != size) {
    refuse(key, "must be a list of " + std::to_string(size) + " numbers");
  }
  std::vector<double> numbers;
  numbers.reserve(entries.size());
  for (const YamlValue& entry : entries) {
    numbers.push_back(number(key, entry));
  }
  return numbers;
}

}  // namespace lockbox
