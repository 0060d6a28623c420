// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/core/file_kind.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace lockbox {

std::string first_bytes(const std::filesystem::path& file) {
  std::string bytes(16, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

const FileKind* find_kind(const std::filesystem::path& file, std::span<const FileKind> kinds) {
  const std::string bytes = first_bytes(file);
  const std::string extension = lower_extension(file) + ' ';
  const auto begins = [&bytes](const FileKind& kind) {
    return !kind.magic.empty() && bytes.starts_with(kind.magic);
  };
  const auto is_named = [&extension](const FileKind& kind) {
    return extension.size() > 1 && kind.extensions.find(extension) != std::string_view::npos;
  };
  auto kind = std::find_if(kinds.begin(), kinds.end(), begins);
  if (kind == kinds.end()) kind = std::find_if(kinds.begin(), kinds.end(), is_named);
  return kind == kinds.end() ? nullptr : &*kind;
}

}  // namespace lockbox
