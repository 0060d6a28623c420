// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/text_file.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "lockbox/core/error.hpp"

namespace lockbox {

std::string read_text_file(const std::filesystem::path& file, std::uintmax_t most_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file.string(), "no such file");
  if (std::filesystem::is_directory(status)) {
    throw InputError(file.string(), "is a folder; give the file in it");
  }
  // A device or a pipe could deliver for ever.
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(file.string(), "not a regular file");
  }
  if (std::filesystem::file_size(file, error) > most_bytes) {
    throw InputError(file.string(), "larger than " + std::to_string(most_bytes / 1'000'000) +
                                        " MB, too large for what is read here");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(file.string(), "cannot be read; are you allowed to?");
  return text;
}

}  // namespace lockbox
