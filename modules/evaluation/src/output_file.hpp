// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>

namespace lockbox {

/// A text file to write; failures name the file instead of passing silently.
class OutputFile {
 public:
  /// Throws InputError if the file cannot be made.
  explicit OutputFile(std::filesystem::path path);

  std::ostream& stream() { return stream_; }

  /// Throws InputError if not everything could be written.
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace lockbox
