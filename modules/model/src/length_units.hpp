// SPDX-License-Identifier: BSD-3-Clause
// Which unit a length was probably meant in that is absurd in metres.
#pragma once

#include <optional>
#include <vector>

namespace lockbox {

/// Metres. Of what is smaller a depth camera shows a few pixels; what is larger it never sees
/// whole.
inline constexpr double kSmallestSeen = 0.005;
inline constexpr double kLargestSeen = 10.0;

/// Metres. A link beyond it is refused: its fields and samples would fill the memory. Twice as much
/// is four times the surface.
inline constexpr double kLargestLink = 20.0;

/// A length that is so many times all others of its model is hardly in their unit.
inline constexpr double kOutOfProportion = 20.0;

struct LengthUnit {
  const char* name;  ///< plural
  double metres;
};

bool is_size_of_things(double metres);

/// The median of those lengths that are sizes of things; 0.3 m if none is. Metres.
double usual_length(std::vector<double> lengths);

/// The most probable unit of a number that is absurd in metres, given what is usual in its model
/// (metres). Nothing if no unit makes it the size of a thing.
std::optional<LengthUnit> probable_unit(double number, double usual);

/// What it may as well be: the next probable unit, where that is no less than a twentieth as
/// probable.
std::optional<LengthUnit> other_unit(double number, double usual);

}  // namespace lockbox
