// SPDX-License-Identifier: BSD-3-Clause
#include "option_checks.hpp"

#include <filesystem>

#include "lockbox/core/error.hpp"
#include "lockbox/core/number_text.hpp"

namespace lockbox::app {

CLI::Validator positive() {
  return {[](std::string& text) -> std::string {
            const auto value = parse_number(text);
            return value && *value > 0.0 ? "" : in_quotes(text) + " is not a positive number";
          },
          "POSITIVE"};
}

CLI::Validator not_negative() {
  return {[](std::string& text) -> std::string {
            const auto value = parse_number(text);
            return value && *value >= 0.0 ? "" : in_quotes(text) + " is neither 0 nor positive";
          },
          "NONNEGATIVE"};
}

CLI::Validator recording_name() {
  return {[](std::string& text) -> std::string {
            return std::filesystem::path(text).extension() == ".oni"
                       ? ""
                       : in_quotes(text) + " does not end in .oni, as recordings do";
          },
          ""};
}

}  // namespace lockbox::app
