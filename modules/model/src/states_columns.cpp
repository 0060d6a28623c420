// SPDX-License-Identifier: BSD-3-Clause
#include "states_columns.hpp"

#include <algorithm>

namespace lockbox {
namespace {

constexpr std::array<std::string_view, 6> kStatusColumns = {
    "residual_rms", "explained", "contradicted", "latency_ms", "belief", "alternatives"};
constexpr std::string_view kSigmaSuffix = ".sigma";

}  // namespace

bool is_reserved_column(std::string_view name) {
  const auto is_name = [name](std::string_view column) { return column == name; };
  const bool is_sigma = name.size() >= kSigmaSuffix.size() &&
                        name.substr(name.size() - kSigmaSuffix.size()) == kSigmaSuffix;
  return is_sigma || name == kStatusColumn ||
         std::any_of(kPoseColumns.begin(), kPoseColumns.end(), is_name) ||
         std::any_of(kStatusColumns.begin(), kStatusColumns.end(), is_name);
}

}  // namespace lockbox
