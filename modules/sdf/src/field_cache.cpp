// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/sdf/field_cache.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "field_file.hpp"
#include "lockbox/core/existing_path.hpp"
#include "lockbox/mesh/content_hash.hpp"

namespace lockbox {
namespace {

std::uint64_t key_of(const TriangleMesh& mesh, const FieldOptions& options) {
  ContentHash hash;
  hash.add(std::uint64_t{kFieldFormat});
  hash.add(content_hash(mesh));
  hash.add(options.voxel);
  hash.add(options.band);
  hash.add(options.far_reach);
  hash.add(options.memory_budget);
  return hash.value();
}

constexpr auto kExtension = ".field";

std::filesystem::path file_for(const std::filesystem::path& folder, std::uint64_t key) {
  return folder / (hash_text(key) + kExtension);
}

std::optional<SignedDistanceField::Storage> read(const std::filesystem::path& file,
                                                 std::uint64_t key) {
  // To open a pipe would wait for who writes into it; what is larger was never kept.
  if (!is_file(file)) return std::nullopt;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > kMostCachedBytes) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  // Used just now. Where that cannot be noted, the field goes as if it had not been.
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
  return from_bytes(bytes, key);
}

bool write_all(int descriptor, const std::string& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t n = ::write(descriptor, bytes.data() + written, bytes.size() - written);
    if (n <= 0) {
      return false;
    }
    written += static_cast<std::size_t>(n);
  }
  return true;
}

/// Writes a file that has no name until it is complete: a process that is ended meanwhile leaves
/// nothing. False if the file system has no such files.
bool write_nameless(const std::filesystem::path& file, const std::string& bytes) {
  const int descriptor = ::open(file.parent_path().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (descriptor < 0) return false;
  const std::string nameless = "/proc/self/fd/" + std::to_string(descriptor);
  bool is_done = true;
  if (write_all(descriptor, bytes)) {
    ::unlink(file.c_str());  // what was found damaged
    is_done =
        ::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, file.c_str(), AT_SYMLINK_FOLLOW) == 0 ||
        errno == EEXIST;  // another process was faster
  }
  ::close(descriptor);
  return is_done;
}

/// Under a name of its own first.
void write_and_rename(const std::filesystem::path& file, const std::string& bytes) {
  std::string temporary = file.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(temporary.data());
  if (descriptor < 0) return;
  const bool is_written = write_all(descriptor, bytes);
  const bool is_closed = ::close(descriptor) == 0;
  if (!is_written || !is_closed || std::rename(temporary.c_str(), file.c_str()) != 0) {
    ::unlink(temporary.c_str());
  }
}

/// So that nobody ever reads half a file. Failing is no error: the field is built again next time.
void write(const std::filesystem::path& file, const std::string& bytes) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (!write_nameless(file, bytes)) write_and_rename(file, bytes);
}

struct CachedFile {
  std::filesystem::path path;
  std::uintmax_t bytes;
  std::filesystem::file_time_type used;
};

/// The one used last first. What other processes delete meanwhile is left out.
std::vector<CachedFile> files_in(const std::filesystem::path& folder) {
  std::vector<CachedFile> files;
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (entry->path().extension() != kExtension) continue;
    std::error_code gone;
    const std::uintmax_t bytes = entry->file_size(gone);
    if (gone) continue;
    const auto used = entry->last_write_time(gone);
    if (!gone) files.push_back({entry->path(), bytes, used});
  }
  std::sort(files.begin(), files.end(), [](const CachedFile& a, const CachedFile& b) {
    return std::tie(b.used, a.path) < std::tie(a.used, b.path);
  });
  return files;
}

}  // namespace

CachedFields cached_fields(const std::filesystem::path& folder) {
  CachedFields all;
  for (const CachedFile& file : files_in(folder)) {
    ++all.files;
    all.bytes += file.bytes;
  }
  return all;
}

CachedFields limit_fields(const std::filesystem::path& folder, std::uintmax_t most_bytes) {
  CachedFields kept;
  for (const CachedFile& file : files_in(folder)) {
    std::error_code error;
    const bool is_too_much = kept.bytes + file.bytes > most_bytes;
    if (is_too_much && std::filesystem::remove(file.path, error)) continue;
    ++kept.files;
    kept.bytes += file.bytes;
  }
  return kept;
}

SignedDistanceField load_or_build_field(const TriangleMesh& mesh, const FieldOptions& options,
                                        const std::filesystem::path& folder,
                                        const Executor& executor) {
  if (folder.empty()) {
    return build_field(mesh, options, executor);
  }
  const std::uint64_t key = key_of(mesh, options);
  const std::filesystem::path file = file_for(folder, key);
  if (auto storage = read(file, key)) {
    return SignedDistanceField(*std::move(storage));
  }
  SignedDistanceField field = build_field(mesh, options, executor);
  write(file, to_bytes(field.storage(), key));
  limit_fields(folder, kMostCachedBytes);
  return field;
}

}  // namespace lockbox
