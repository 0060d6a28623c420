// SPDX-License-Identifier: BSD-3-Clause
// Numbers as people read them in a message: rounded, without an exponent.
#pragma once

#include <string>

namespace lockbox {

/// The value rounded to that many significant digits (one at least): "0.05", "1.57", "380000". nan
/// and infinities by name.
std::string readable_number(double value, int digits = 3);

/// A length in the unit that suits it, to three digits: "0.3 um", "12.5 mm", "60 m". metres:
/// finite.
std::string readable_length(double metres);

}  // namespace lockbox
