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

/// Logarithm of twenty: what is that much less probable is not worth a word.
constexpr double kToldApart = 3.0;

struct PossibleUnit {
  LengthUnit unit;
  double logarithm;  ///< of its probability, but for a constant
};

/// Returns the units that make the number the size of a thing, the most probable first.
std::vector<PossibleUnit> possible_units(double number, double usual) {
  std::vector<PossibleUnit> units;
  for (const UnitShare& candidate : kUnits) {
    if (!is_size_of_things(number * candidate.unit.metres)) continue;
    units.push_back({candidate.unit, log_probability(candidate, number, usual)});
  }
  std::stable_sort(units.begin(), units.end(), [](const auto& one, const auto& other) {
    return one.logarithm > other.logarithm;
  });
  return units;
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
  const auto units = possible_units(number, usual);
  return units.empty() ? std::nullopt : std::optional(units.front().unit);
}

std::optional<LengthUnit> other_unit(double number, double usual) {
  const auto units = possible_units(number, usual);
  const bool is_told = units.size() < 2 || units[0].logarithm - units[1].logarithm > kToldApart;
  return is_told ? std::nullopt : std::optional(units[1].unit);
}

}  // namespace lockbox
