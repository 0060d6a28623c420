// SPDX-License-Identifier: BSD-3-Clause
// The records that a .oni file is made of (docs/recordings.md has the layout).
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
  node_added_1_0_0_4 = 0x2,  ///< without the number of frames, timestamps and seek table
  int_property = 0x3,
  real_property = 0x4,
  string_property = 0x5,
  general_property = 0x6,
  node_removed = 0x7,
  data_begin = 0x8,
  state_ready = 0x9,
  new_data = 0xA,
  end = 0xB,
  node_added_1_0_0_5 = 0xC,  ///< without a seek table
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

/// What the player can hold of an image that is not encoded, or of its encoding, bytes.
inline constexpr std::uint64_t kOniPlayerImage = 1600 * 1200 * 3;

/// What the player can hold of a record: an image, and the record's header and fields.
inline constexpr std::uint64_t kOniPlayerRecord = kOniPlayerImage + 40;

/// The 24 bytes at the beginning.
struct OniHeader {
  static constexpr std::uint64_t kSize = 24;
  /// The greatest node until OpenNI 1 has finished the recording.
  static constexpr std::uint32_t kUnfinished = 0xFFFFFFFF;
  bool has_short_offsets;           ///< 32 bits, before version 1.0.1.0
  std::uint64_t maximum_timestamp;  ///< microseconds
  std::uint32_t maximum_node;

  std::uint32_t record_header_size() const { return has_short_offsets ? 24 : 28; }
};

/// Throws InputError if the file does not begin like a recording of a supported version.
OniHeader read_oni_header(const OniFile& file);

/// Whether the recording breaks off at offset, where a record should begin: the file ends there or
/// within that record, or holds nothing but zeros from there on, as after a loss of power.
bool breaks_off(const OniFile& file, const OniHeader& header, std::uint64_t offset);

/// One record: its header and fields, without its payload.
class OniRecord {
 public:
  /// Reads the record at offset. Throws InputError if it is damaged.
  OniRecord(const OniFile& file, const OniHeader& header, std::uint64_t offset);

  OniRecordType type() const { return static_cast<OniRecordType>(type_); }
  std::uint32_t node() const { return node_; }
  const OniFile& file() const { return file_; }
  std::uint64_t offset() const { return offset_; }
  std::uint64_t payload_offset() const { return offset_ + header_size_ + fields_.size(); }
  std::uint32_t payload_size() const { return payload_size_; }
  std::uint64_t next_offset() const { return payload_offset() + payload_size_; }

  /// Takes the next field, a number.
  template <typename T>
  T take() {
    T value;
    std::memcpy(&value, take_bytes(sizeof(T)), sizeof(T));
    return value;
  }

  /// Takes the next field, an offset in the file, whose size depends on the version.
  std::uint64_t take_offset();

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
  bool has_short_offsets_;
  std::uint32_t header_size_;
  std::uint32_t type_ = 0;
  std::uint32_t node_ = 0;
  std::uint32_t payload_size_ = 0;
  std::vector<std::uint8_t> fields_;
  std::size_t taken_ = 0;
};

}  // namespace lockbox
