// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/yaml_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox {

YAML::Node load_yaml(const std::filesystem::path& file, const std::string& kind) {
  if (!is_file(file)) {
    throw InputError(file.string(), "is not a " + kind + " file that can be read");
  }
  const std::string text = read_text_file(file, kMostWrittenBytes);
  try {
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw InputError(file.string(), error.mark.line + 1, "is not YAML: " + error.msg);
  }
}

YamlMap::YamlMap(const std::string& file, const YAML::Node& node,
                 std::initializer_list<const char*> known_keys)
    : file_(file), node_(node) {
  if (!node.IsMap()) {
    throw InputError(file, std::max(1, node.Mark().line + 1), "a map (key: value) is needed here");
  }
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const int line = entry.first.Mark().line + 1;
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "";
    if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
      std::string choices;
      for (const char* known : known_keys) {
        choices += choices.empty() ? known : std::string(", ") + known;
      }
      throw InputError(file, line, "unknown key '" + key + "'; known here: " + choices);
    }
    if (!seen.insert(key).second) {
      throw InputError(file, line, "the key '" + key + "' stands there twice");
    }
  }
}

void YamlMap::read(const char* key, std::string& value) const {
  if (has(key)) {
    if (!node_[key].IsScalar()) {
      refuse(key, "must be a word");
    }
    value = node_[key].Scalar();
  }
}

void YamlMap::read(const char* key, double& value) const {
  if (has(key)) {
    value = number(key, node_[key]);
  }
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
  for (const YAML::Node& item : items(key)) {
    if (!item.IsScalar()) refuse(key, "must be a list of words");
    words.push_back(item.Scalar());
  }
}

std::vector<YAML::Node> YamlMap::items(const char* key) const {
  if (!has(key)) {
    return {};
  }
  if (!node_[key].IsSequence()) {
    refuse(key, "must be a list");
  }
  return {node_[key].begin(), node_[key].end()};
}

void YamlMap::require(const char* key) const {
  if (!has(key)) {
    throw InputError(file_, node_.Mark().line + 1, "the key '" + std::string(key) + "' is missing");
  }
}

void YamlMap::refuse(const char* key, const std::string& problem) const {
  const YAML::Node at = has(key) ? node_[key] : node_;
  throw InputError(file_, at.Mark().line + 1, "'" + std::string(key) + "' " + problem);
}

double YamlMap::number(const char* key, const YAML::Node& node) const {
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  const auto value = parse_finite_number(text);
  if (!value) {
    refuse(key, "needs finite numbers");
  }
  return *value;
}

std::vector<double> YamlMap::read_list(const char* key, std::size_t size) const {
  const std::vector<YAML::Node> entries = items(key);
  if (entries.size() != size) {
    refuse(key, "must be a list of " + std::to_string(size) + " numbers");
  }
  std::vector<double> numbers;
  numbers.reserve(entries.size());
  for (const YAML::Node& entry : entries) {
    numbers.push_back(number(key, entry));
  }
  return numbers;
}

}  // namespace lockbox
