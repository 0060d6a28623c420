// SPDX-License-Identifier: BSD-3-Clause
// The records that a .oni file is made of (docs/file-formats.md has the layout).
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lockbox/core/error.hpp"

namespace lockbox {

enum class OniRecordType : std::uint32_t {
  int_property = 0x3,
  real_property = 0x4,
  string_property = 0x5,
  general_property = 0x6,
  node_removed = 0x7,
  data_begin = 0x8,
  state_ready = 0x9,
  new_data = 0xA,
  end = 0xB,
  node_added = 0xD,
  seek_table = 0xE,
};

enum class OniNodeType : std::uint32_t { device = 1, depth = 2, image = 3, infrared = 5 };

/// Positional, checked reads of a regular file.
class OniFile {
 public:
  /// Throws InputError if there is no regular file, it is empty, or it cannot be read.
  explicit OniFile(const std::filesystem::path& file);
  ~OniFile();
  OniFile(const OniFile&) = delete;
  OniFile& operator=(const OniFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }

  /// Throws InputError if the file ends before offset + size.
  void read(std::uint64_t offset, void* destination, std::size_t size) const;

  /// The file is damaged there: throws InputError.
  [[noreturn]] void refuse(std::uint64_t offset, const std::string& problem) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// The 24 bytes at the beginning.
struct OniHeader {
  static constexpr std::uint64_t kSize = 24;
  std::uint64_t maximum_timestamp;  ///< microseconds
  std::uint32_t maximum_node;
};

/// Throws InputError if the file does not begin like a recording of a supported version.
OniHeader read_oni_header(const OniFile& file);

/// One record: its header and fields, without its payload.
class OniRecord {
 public:
  static constexpr std::uint32_t kHeaderSize = 28;

  /// Reads the record at offset. Throws InputError if it is damaged.
  OniRecord(const OniFile& file, std::uint64_t offset);

  OniRecordType type() const { return static_cast<OniRecordType>(type_); }
  std::uint32_t node() const { return node_; }
  const OniFile& file() const { return file_; }
  std::uint64_t offset() const { return offset_; }
  std::uint64_t payload_offset() const { return offset_ + kHeaderSize + fields_.size(); }
  std::uint32_t payload_size() const { return payload_size_; }
  std::uint64_t next_offset() const { return payload_offset() + payload_size_; }

  /// Takes the next field, a number.
  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, take_bytes(sizeof(T)), sizeof(T));
    return value;
  }

  /// Takes the next field: a length and as many bytes.
  std::vector<std::uint8_t> take_data();

  /// Takes the next field, a name: printable ASCII, as the player's hash table crashes on others.
  std::string take_name();

  /// All fields must have been taken.
  void finish() const;

  [[noreturn]] void refuse(const std::string& problem) const { file_.refuse(offset_, problem); }

 private:
  const std::uint8_t* take_bytes(std::size_t count);

  const OniFile& file_;
  std::uint64_t offset_;
  std::uint32_t type_ = 0;
  std::uint32_t node_ = 0;
  std::uint32_t payload_size_ = 0;
  std::vector<std::uint8_t> fields_;
  std::size_t taken_ = 0;
};

}  // namespace lockbox
