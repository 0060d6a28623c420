// SPDX-License-Identifier: BSD-3-Clause
#include "model_keys.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string_view>
#include <vector>

#include "lockbox/core/error.hpp"
#include "lockbox/core/yaml_value.hpp"

namespace lockbox {
namespace {

/// Letters to insert, drop or replace to make one word of the other (Levenshtein).
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// "version" must not pass for "erosion", nor "model" for "voxel".
bool is_like_a_key(std::string_view word) {
  constexpr std::size_t kShort = 8;
  constexpr std::size_t kLongest = 20;  // of our keys 13; longer words are none of them
  if (word.size() > kLongest) return false;
  std::istringstream keys(kKeyList);
  for (std::string key; std::getline(keys >> std::ws, key, ',');) {
    const std::size_t misspelt = key.size() <= kShort ? 1 : 2;
    if (letters_apart(word, key) <= misspelt) return true;
  }
  return false;
}

/// Returns, for text that is no YAML, whether a line begins, at the margin, with a key.
bool has_line_of_a_key(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find_first_of(": ");
    if (colon != std::string::npos && is_like_a_key(std::string_view(line).substr(0, colon))) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool names_model_keys(const std::string& file, const std::string& text) {
  try {
    const YamlValue top = YamlValue::parse(file, text);
    if (top.is_empty()) return true;
    const std::vector<std::string> keys = top.plain_keys();
    return std::any_of(keys.begin(), keys.end(), is_like_a_key);
  } catch (const InputError&) {
    return has_line_of_a_key(text);
  }
}

}  // namespace lockbox
