// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lockbox {

/// what() of the error that the call throws; "no error" if it throws none.
template <typename Error, typename Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace lockbox
