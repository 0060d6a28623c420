// SPDX-License-Identifier: BSD-3-Clause
// Errors that a user can mend: they say what is wrong, where, and what to do.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace lockbox {

/// An input (file, folder, model, option value) is missing or invalid.
/// what() reads "WHERE: what is wrong", where WHERE is a file, with ":LINE" behind it if known.
class InputError : public std::runtime_error {
 public:
  /// where: names the file, folder, option or the like.
  InputError(const std::string& where, const std::string& problem);
  /// line: is counted from 1.
  InputError(const std::string& file, int line, const std::string& problem);
};

/// A camera or the OpenNI2 runtime failed, or stopped delivering frames.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns 'text' for messages, cut short where it would fill a screen.
std::string in_quotes(std::string_view text);

}  // namespace lockbox
