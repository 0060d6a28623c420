// SPDX-License-Identifier: BSD-3-Clause
#include "length_units.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lockbox {
namespace {

struct UnitShare {
  LengthUnit unit;
  double share;  ///< of the models that are in a wrong unit; by what users of trackers report
};

constexpr std::array kUnits = {
    UnitShare{{"millimetres", 0.001}, 0.9}, UnitShare{{"centimetres", 0.01}, 0.07},
    UnitShare{{"inches", 0.0254}, 0.02}, UnitShare{{"micrometres", 1e-6}, 0.01}};

/// Logarithm of a unit's probability, but for a constant.
double log_probability(const UnitShare& candidate, double number, double usual) {
  constexpr double kSpread = 1.6;  // logarithm of five: parts of one object differ by that much
  const double off = std::log(number * candidate.unit.metres / usual) / kSpread;
  return std::log(candidate.share) - 0.5 * off * off;
}

}  // namespace

bool is_size_of_things(double metres) {
  return metres >= kSmallestSeen && metres <= kLargestSeen;
}

double usual_length(std::vector<double> lengths) {
  constexpr double kHandy = 0.3;
  std::erase_if(lengths, [](double length) { return !is_size_of_things(length); });
  if (lengths.empty()) return kHandy;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

std::optional<LengthUnit> probable_unit(double number, double usual) {
  const UnitShare* best = nullptr;
  for (const UnitShare& candidate : kUnits) {
    if (!is_size_of_things(number * candidate.unit.metres)) continue;
    if (best == nullptr ||
        log_probability(candidate, number, usual) > log_probability(*best, number, usual)) {
      best = &candidate;
    }
  }
  return best == nullptr ? std::nullopt : std::optional(best->unit);
}

}  // namespace lockbox
