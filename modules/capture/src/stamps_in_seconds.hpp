// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lockbox {

/// Divides stamps that are evidently in milli-, micro- or nanoseconds (core/stamp_unit.hpp), and
/// tells warn, if it is set; of those that only may be in milliseconds it tells so. where: a file
/// or folder, for the message.
void bring_to_seconds(std::vector<double>& stamps, const std::string& where,
                      const std::function<void(const std::string&)>& warn);

}  // namespace lockbox
