// SPDX-License-Identifier: BSD-3-Clause
// What the targets of libFuzzer share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "lockbox/core/error.hpp"
#include "temporary_folder.hpp"

namespace lockbox {

inline std::string as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the process, which libFuzzer calls a finding.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

/// What reads files of this folder takes them, or refuses them with the name of one. All else,
/// other exceptions too, ends the process.
template <typename Read>
void take_or_refuse(const TemporaryFolder& folder, const Read& read) {
  try {
    read();
  } catch (const InputError& refusal) {
    const std::string_view message = refusal.what();
    if (message.find(folder.path().native()) != std::string_view::npos) return;
    std::fprintf(stderr, "refused without the name of a file: %s\n", refusal.what());
    std::abort();
  }
}

/// Gives the bytes, as a file of this name, to a reader. Returns what libFuzzer wants.
template <typename Read>
int read_as(const std::string& name, const std::uint8_t* data, std::size_t size, const Read& read) {
  static const TemporaryFolder folder;
  const auto file = folder.write(name, as_text(data, size));
  take_or_refuse(folder, [&] { read(file); });
  return 0;
}

}  // namespace lockbox
