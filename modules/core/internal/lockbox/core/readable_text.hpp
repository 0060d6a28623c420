// SPDX-License-Identifier: BSD-3-Clause
// Numbers as people read them in a message: rounded, without an exponent.
#pragma once

#include <string>

namespace lockbox {

/// The value rounded to that many significant digits (one at least): "0.05", "1.57", "380000". What
/// is smaller than 1e-12 is 0; from 1e18 on, nan and infinity included, it is as number_text has
/// it.
std::string readable_number(double value, int digits = 3);

/// A length in the unit that suits it, to three digits: "0.3 um", "12.5 mm", "60 m". metres:
/// finite.
std::string readable_length(double metres);

}  // namespace lockbox
