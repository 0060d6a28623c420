// SPDX-License-Identifier: BSD-3-Clause
#include "whole_file.hpp"

#include <fstream>

#include "lockbox/core/error.hpp"

namespace lockbox::app {

void write_whole_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path unfinished = file.string() + ".part";
  std::ofstream stream(unfinished);
  stream << text;
  stream.close();
  if (!stream) throw InputError(file.string(), "cannot be written; is there space on the disk?");
  std::filesystem::rename(unfinished, file);
}

}  // namespace lockbox::app
