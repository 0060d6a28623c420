// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lockbox::app {

/// The name that was probably meant: it begins with what was written, or differs from it by the
/// fewest letters put in, left out, changed, or swapped with their neighbours, up to a third of
/// what was written and three; none if there is no such name.
std::optional<std::string> nearest_name(const std::string& written,
                                        const std::vector<std::string>& names);

/// "; did you mean --model?", or nothing.
std::string did_you_mean(const std::string& written, const std::vector<std::string>& names);

}  // namespace lockbox::app
