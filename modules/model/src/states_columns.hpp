// SPDX-License-Identifier: BSD-3-Clause
// The columns of a states file that are not joints.
#pragma once

#include <array>
#include <string_view>

namespace lockbox {

inline constexpr std::array<std::string_view, 8> kPoseColumns = {"timestamp", "tx", "ty", "tz",
                                                                 "qx",        "qy", "qz", "qw"};
inline constexpr std::string_view kStatusColumn = "status";

/// Whether a column of that name has a meaning of its own, so that no joint may be called so.
bool is_reserved_column(std::string_view name);

}  // namespace lockbox
