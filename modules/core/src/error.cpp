// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/error.hpp"

namespace lockbox {

InputError::InputError(const std::string& where, const std::string& problem)
    : std::runtime_error(where + ": " + problem) {}

InputError::InputError(const std::string& file, int line, const std::string& problem)
    : InputError(file + ":" + std::to_string(line), problem) {}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 120;
  return std::string("'").append(text.substr(0, kLongest)).append("'");
}

}  // namespace lockbox
