// SPDX-License-Identifier: BSD-3-Clause
#include "output_file.hpp"

#include <locale>
#include <utility>

#include "lockbox/core/error.hpp"

namespace lockbox {

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), stream_(path_) {
  if (!stream_) throw InputError(path_.string(), "cannot be written; does its folder exist?");
  stream_.imbue(std::locale::classic());
}

void OutputFile::close() {
  stream_.close();
  if (!stream_) throw InputError(path_.string(), "could not be written to its end; disk full?");
}

}  // namespace lockbox
