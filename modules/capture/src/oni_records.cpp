// SPDX-License-Identifier: BSD-3-Clause
#include "oni_records.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace lockbox {
namespace {

constexpr std::uint32_t kRecordMagic = 0x0052494E;  // "NIR\0"
// The player reads a record into a buffer of this size without looking.
constexpr std::uint64_t kPlayerBuffer = 1600 * 1200 * 3 + 40;
constexpr std::uint32_t kMaximumFields = 1 << 20;  // bytes; the largest in use are tables of 20 kB
constexpr std::size_t kMaximumName = 79;           // characters, the player's limit
constexpr std::uint32_t kMaximumNode = 16;

std::uint64_t checked_size(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(path.string(), "no such file");
  }
  if (std::filesystem::is_directory(path)) {
    throw InputError(path.string(), "is a folder, not an .oni recording");
  }
  if (!std::filesystem::is_regular_file(path)) {
    throw InputError(path.string(), "is not a regular file; an .oni recording must be one");
  }
  const std::uint64_t size = std::filesystem::file_size(path);
  if (size == 0) {
    throw InputError(path.string(), "is empty (0 bytes); nothing was recorded, record it again");
  }
  return size;
}

}  // namespace

OniFile::OniFile(const std::filesystem::path& file)
    : path_(file), descriptor_(-1), size_(checked_size(file)) {
  descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw InputError(file.string(), "cannot be read; check its permissions");
  }
}

OniFile::~OniFile() {
  ::close(descriptor_);
}

void OniFile::read(std::uint64_t offset, void* destination, std::size_t size) const {
  auto* to = static_cast<char*>(destination);
  while (size > 0) {
    const ssize_t count = ::pread(descriptor_, to, size, static_cast<off_t>(offset));
    if (count <= 0) {
      throw InputError(path_.string(), "is truncated or unfinished: it ends at byte " +
                                           std::to_string(size_) +
                                           " without the end mark of a finished recording; copy or "
                                           "record it again");
    }
    to += count;
    offset += static_cast<std::uint64_t>(count);
    size -= static_cast<std::size_t>(count);
  }
}

void OniFile::refuse(std::uint64_t offset, const std::string& problem) const {
  throw InputError(path_.string(), "is damaged in the record at byte " + std::to_string(offset) +
                                       ": " + problem + "; copy or record it again");
}

OniHeader read_oni_header(const OniFile& file) {
  std::array<char, OniHeader::kSize> bytes{};
  const std::size_t available = std::min<std::uint64_t>(file.size(), bytes.size());
  file.read(0, bytes.data(), available);
  if (available < 4 || std::string_view(bytes.data(), 4) != "NI10") {
    throw InputError(file.path().string(),
                     "is not an OpenNI recording (it does not begin with NI10)");
  }
  if (available < bytes.size()) {
    throw InputError(file.path().string(), "is truncated: it ends within the header, at byte " +
                                               std::to_string(file.size()));
  }
  const std::string_view supported("\x01\x00\x01\x00\x00\x00\x00\x00", 8);
  if (std::string_view(bytes.data() + 4, 8) != supported) {
    throw InputError(file.path().string(),
                     "is an OpenNI recording of format version " +
                         std::to_string(static_cast<unsigned char>(bytes[4])) + "." +
                         std::to_string(static_cast<unsigned char>(bytes[5])) + "." +
                         std::to_string(static_cast<unsigned char>(bytes[6])) +
                         ".*; only 1.0.1.0 (OpenNI 1.3 and later) is supported");
  }
  OniHeader header{};
  std::memcpy(&header.maximum_timestamp, bytes.data() + 12, 8);
  std::memcpy(&header.maximum_node, bytes.data() + 20, 4);
  if (header.maximum_node > kMaximumNode) {
    file.refuse(0, "it claims " + std::to_string(header.maximum_node) + " streams");
  }
  return header;
}

OniRecord::OniRecord(const OniFile& file, std::uint64_t offset) : file_(file), offset_(offset) {
  std::array<std::uint32_t, 7> header{};
  file.read(offset, header.data(), kHeaderSize);
  if (header[0] != kRecordMagic) {
    refuse("no record begins here");
  }
  type_ = header[1];
  node_ = header[2];
  payload_size_ = header[4];
  const std::uint32_t fields_and_header = header[3];
  if (fields_and_header < kHeaderSize || fields_and_header > kMaximumFields ||
      std::uint64_t{fields_and_header} + payload_size_ > kPlayerBuffer) {
    refuse("its size is impossible");
  }
  std::uint64_t undo = 0;
  std::memcpy(&undo, &header[5], sizeof(undo));
  if (undo >= offset) {
    refuse("it refers to a later record as to an earlier one");
  }
  const bool may_have_payload =
      type() == OniRecordType::new_data || type() == OniRecordType::seek_table;
  if (payload_size_ != 0 && !may_have_payload) {
    refuse("it has a payload that its type does not have");
  }
  fields_.resize(fields_and_header - kHeaderSize);
  file.read(offset + kHeaderSize, fields_.data(), fields_.size());
  if (next_offset() > file.size()) {
    throw InputError(file.path().string(),
                     "is truncated: it ends at byte " + std::to_string(file.size()) +
                         " within the record at byte " + std::to_string(offset) +
                         "; copy or record it again");
  }
}

const std::uint8_t* OniRecord::take_bytes(std::size_t count) {
  if (count > fields_.size() - taken_) {
    refuse("it is shorter than its contents");
  }
  taken_ += count;
  return fields_.data() + taken_ - count;
}

std::vector<std::uint8_t> OniRecord::take_data() {
  const auto size = take<std::uint32_t>();
  const std::uint8_t* const bytes = take_bytes(size);
  return {bytes, bytes + size};
}

std::string OniRecord::take_name() {
  const std::vector<std::uint8_t> bytes = take_data();
  const auto printable = [](std::uint8_t character) {
    return character > 0x20 && character < 0x7F;
  };
  if (bytes.size() < 2 || bytes.size() > kMaximumName + 1 || bytes.back() != 0 ||
      !std::all_of(bytes.begin(), bytes.end() - 1, printable)) {
    refuse("it holds a name that is not plain text");
  }
  return {bytes.begin(), bytes.end() - 1};
}

void OniRecord::finish() const {
  if (taken_ != fields_.size()) {
    refuse("it is longer than its contents");
  }
}

}  // namespace lockbox
