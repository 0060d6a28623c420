// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace lockbox {

/// Whether a stands before b where numbers in names count as numbers: `cloud_2` before `cloud_10`,
/// `b/1` behind `a/2`. A strict total order: names that differ in leading zeros only are ordered as
/// text.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace lockbox
