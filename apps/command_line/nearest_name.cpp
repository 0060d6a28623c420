// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_name.hpp"

#include <algorithm>
#include <cstddef>

namespace lockbox::app {
namespace {

/// The distance of Damerau and Levenshtein, with no letter touched twice.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearest_name(const std::string& written,
                                        const std::vector<std::string>& names) {
  constexpr std::size_t kShortest = 3;  // letters of a beginning that says which name is meant
  constexpr std::size_t kMostEdits = 3;
  std::optional<std::string> nearest;
  std::size_t fewest = std::clamp<std::size_t>(written.size() / 3, 1, kMostEdits) + 1;
  for (const auto& name : names) {
    if (written.size() >= kShortest && name.starts_with(written)) return name;
    const std::size_t needed = edits(written, name);
    if (needed < fewest) {
      nearest = name;
      fewest = needed;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& written, const std::vector<std::string>& names) {
  const auto nearest = nearest_name(written, names);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

}  // namespace lockbox::app
