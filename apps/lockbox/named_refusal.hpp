// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "lockbox/core/error.hpp"

namespace lockbox::app {

/// What the call returns. What it refuses without knowing the file that it is from, is told of that
/// file; empty: of none. Throws InputError.
template <typename Call>
auto refused_in(const std::string& file, const Call& call) {
  try {
    return call();
  } catch (const InputError& error) {
    if (file.empty()) throw;
    throw InputError(file, error.what());
  }
}

}  // namespace lockbox::app
