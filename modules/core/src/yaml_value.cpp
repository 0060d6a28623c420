// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/yaml_value.hpp"

#include <algorithm>
#include <set>

#include "lockbox/core/error.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/text_file.hpp"

namespace lockbox {

YamlValue YamlValue::load(const std::filesystem::path& file, const std::string& kind) {
  if (!is_file(file)) {
    throw InputError(file.string(), "is not a " + kind + " file that can be read");
  }
  return parse(file.string(), read_text_file(file, kMostWrittenBytes));
}

YamlValue YamlValue::parse(const std::string& file, const std::string& text) {
  try {
    return {file, YAML::Load(text)};
  } catch (const YAML::Exception& error) {
    throw InputError(file, error.mark.line + 1, "is not YAML: " + error.msg);
  }
}

std::optional<YamlValue> YamlValue::find(const std::string& key) const {
  if (!is_map()) return std::nullopt;
  const YAML::Node value = node_[key];
  if (!value.IsDefined() || value.IsNull()) return std::nullopt;
  return YamlValue{file_, value};
}

std::vector<std::string> YamlValue::plain_keys() const {
  std::vector<std::string> result;
  if (!is_map()) return result;
  for (const auto& entry : node_) {
    if (entry.first.IsScalar()) result.push_back(entry.first.Scalar());
  }
  return result;
}

std::vector<std::pair<YamlValue, YamlValue>> YamlValue::entries() const {
  if (!node_.IsMap()) refuse("a map (key: value) is needed here");
  std::vector<std::pair<YamlValue, YamlValue>> result;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const YamlValue key{file_, entry.first};
    if (!seen.insert(key.text()).second) {
      key.refuse("the key " + in_quotes(key.text()) + " stands there twice");
    }
    result.emplace_back(key, YamlValue{file_, entry.second});
  }
  return result;
}

std::vector<YamlValue> YamlValue::items() const {
  if (!node_.IsSequence()) refuse("a list ([a, b, ...]) is needed here");
  std::vector<YamlValue> result;
  for (const auto& item : node_) result.push_back({file_, item});
  return result;
}

std::vector<YamlValue> YamlValue::items(std::size_t count) const {
  auto result = items();
  if (result.size() != count) {
    refuse("a list of " + std::to_string(count) + " is needed here, not of " +
           std::to_string(result.size()));
  }
  return result;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar()) refuse("a plain value is needed here");
  return node_.Scalar();
}

double YamlValue::number() const {
  const auto value = parse_finite_number(text());
  if (!value) refuse(in_quotes(text()) + " is not a finite number");
  return *value;
}

void YamlValue::refuse(const std::string& problem) const {
  throw InputError(file_, std::max(1, node_.Mark().line + 1), problem);
}

}  // namespace lockbox
