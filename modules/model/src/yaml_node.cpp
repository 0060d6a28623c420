// SPDX-License-Identifier: BSD-3-Clause
#include "yaml_node.hpp"

#include <cmath>
#include <set>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"
#include "lockbox/core/yaml_map.hpp"

namespace lockbox {

YamlNode YamlNode::read(const std::filesystem::path& file) {
  return {file.string(), load_yaml(file, "YAML")};
}

std::vector<std::pair<std::string, YamlNode>> YamlNode::entries() const {
  if (!node_.IsMap()) refuse("a map (key: value) is needed here");
  std::vector<std::pair<std::string, YamlNode>> result;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = YamlNode{file_, entry.first}.text();
    const YamlNode value{file_, entry.second};
    if (!seen.insert(key).second) value.refuse("the key " + in_quotes(key) + " stands there twice");
    result.emplace_back(key, value);
  }
  return result;
}

std::vector<YamlNode> YamlNode::items() const {
  if (!node_.IsSequence()) refuse("a list ([a, b, ...]) is needed here");
  std::vector<YamlNode> result;
  for (const auto& item : node_) result.push_back({file_, item});
  return result;
}

std::vector<YamlNode> YamlNode::items(std::size_t count) const {
  auto result = items();
  if (result.size() != count) {
    refuse("a list of " + std::to_string(count) + " is needed here, not of " +
           std::to_string(result.size()));
  }
  return result;
}

std::string YamlNode::text() const {
  if (!node_.IsScalar()) refuse("a plain value is needed here");
  return node_.Scalar();
}

double YamlNode::number() const {
  const auto value = parse_number(text());
  if (!value || !std::isfinite(*value)) refuse(in_quotes(text()) + " is not a finite number");
  return *value;
}

void YamlNode::refuse(const std::string& problem) const {
  throw InputError(file_, node_.Mark().line + 1, problem);
}

}  // namespace lockbox
