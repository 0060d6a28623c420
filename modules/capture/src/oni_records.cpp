// SPDX-License-Identifier: BSD-3-Clause
#include "oni_records.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

#include "lockbox/core/existing_path.hpp"

namespace lockbox {
namespace {

constexpr std::uint32_t kRecordMagic = 0x0052494E;  // "NIR\0"
constexpr std::uint32_t kMaximumFields = 1 << 20;   // bytes; the largest in use are tables of 20 kB
constexpr std::size_t kMaximumName = 79;            // characters, the player's limit
constexpr std::uint32_t kMaximumNode = 16;
// Versions that the player reads, as major, minor, maintenance and build.
constexpr std::array<std::uint32_t, 4> kOldestVersion = {1, 0, 0, 4};
constexpr std::array<std::uint32_t, 4> kNewestVersion = {1, 0, 1, 0};

/// What every record begins with; the offset of an earlier record follows, which serves seeking.
struct RecordStart {
  std::uint32_t magic;
  std::uint32_t type;
  std::uint32_t node;
  std::uint32_t fields;   // bytes, with the header
  std::uint32_t payload;  // bytes

  std::uint64_t size() const { return std::uint64_t{fields} + payload; }
};
static_assert(sizeof(RecordStart) == 20);

/// The player reads a record into its buffer without looking; seek tables can be left out.
bool is_possible(const RecordStart& record, const OniHeader& header) {
  const bool is_seek_table = static_cast<OniRecordType>(record.type) == OniRecordType::seek_table;
  return record.fields >= header.record_header_size() && record.fields <= kMaximumFields &&
         (is_seek_table || record.size() <= kOniPlayerRecord);
}

bool is_zero_from(const OniFile& file, std::uint64_t offset) {
  std::array<char, 1 << 16> chunk{};
  for (; offset < file.size(); offset += chunk.size()) {
    const std::size_t size = std::min<std::uint64_t>(chunk.size(), file.size() - offset);
    file.read(offset, chunk.data(), size);
    if (std::any_of(chunk.begin(), chunk.begin() + size, [](char byte) { return byte != 0; })) {
      return false;
    }
  }
  return true;
}

std::uint64_t checked_size(const std::filesystem::path& path) {
  if (!is_there(path)) {
    throw InputError(path.string(), "no such file");
  }
  if (is_folder(path)) {
    throw InputError(path.string(), "is a folder, not an .oni recording");
  }
  if (!is_file(path)) {
    throw InputError(path.string(), "is not a regular file; an .oni recording must be one");
  }
  const std::uint64_t size = std::filesystem::file_size(path);
  if (size == 0) {
    throw InputError(path.string(), "is empty (0 bytes); nothing was recorded, record it again");
  }
  return size;
}

std::array<std::uint32_t, 4> supported_version(const OniFile& file,
                                               const std::array<char, OniHeader::kSize>& header) {
  std::uint16_t maintenance = 0;
  std::uint32_t build = 0;
  std::memcpy(&maintenance, header.data() + 6, sizeof(maintenance));
  std::memcpy(&build, header.data() + 8, sizeof(build));
  const std::array<std::uint32_t, 4> version = {static_cast<unsigned char>(header[4]),
                                                static_cast<unsigned char>(header[5]), maintenance,
                                                build};
  if (version < kOldestVersion || version > kNewestVersion) {
    throw InputError(file.path().string(),
                     "is an OpenNI recording of format version " + std::to_string(version[0]) +
                         "." + std::to_string(version[1]) + "." + std::to_string(version[2]) + "." +
                         std::to_string(version[3]) + "; 1.0.0.4 to 1.0.1.0 are supported");
  }
  return version;
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
      throw InputError(path_.string(), "is truncated: it ends at byte " + std::to_string(size_) +
                                           "; copy or record it again");
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
  OniHeader header{};
  header.has_short_offsets = supported_version(file, bytes) < kNewestVersion;
  std::memcpy(&header.maximum_timestamp, bytes.data() + 12, 8);
  std::memcpy(&header.maximum_node, bytes.data() + 20, 4);
  if (header.maximum_node > kMaximumNode && header.maximum_node != OniHeader::kUnfinished) {
    file.refuse(0, "it claims " + std::to_string(header.maximum_node) + " streams");
  }
  return header;
}

bool breaks_off(const OniFile& file, const OniHeader& header, std::uint64_t offset) {
  RecordStart record{};
  if (file.size() - offset < header.record_header_size()) {
    return true;
  }
  file.read(offset, &record, sizeof(record));
  if (record.magic == kRecordMagic) {
    return is_possible(record, header) && record.size() > file.size() - offset;
  }
  return record.magic == 0 && is_zero_from(file, offset);
}

OniRecord::OniRecord(const OniFile& file, const OniHeader& header, std::uint64_t offset)
    : file_(file),
      offset_(offset),
      has_short_offsets_(header.has_short_offsets),
      header_size_(header.record_header_size()) {
  RecordStart record{};
  file.read(offset, &record, sizeof(record));
  if (record.magic != kRecordMagic) {
    refuse("no record begins here");
  }
  type_ = record.type;
  node_ = record.node;
  payload_size_ = record.payload;
  if (!is_possible(record, header)) {
    refuse("its size is impossible");
  }
  const bool may_have_payload =
      type() == OniRecordType::new_data || type() == OniRecordType::seek_table;
  if (payload_size_ != 0 && !may_have_payload) {
    refuse("it has a payload that its type does not have");
  }
  fields_.resize(record.fields - header_size_);
  file.read(offset + header_size_, fields_.data(), fields_.size());
  if (next_offset() > file.size()) {
    refuse("it ends behind the end of the file");
  }
}

const std::uint8_t* OniRecord::take_bytes(std::size_t count) {
  if (count > fields_.size() - taken_) {
    refuse("it is shorter than its contents");
  }
  taken_ += count;
  return fields_.data() + taken_ - count;
}

std::uint64_t OniRecord::take_offset() {
  return has_short_offsets_ ? take<std::uint32_t>() : take<std::uint64_t>();
}

std::vector<std::uint8_t> OniRecord::take_data() {
  const auto size = take<std::uint32_t>();
  const std::uint8_t* const bytes = take_bytes(size);
  return {bytes, bytes + size};
}

std::string OniRecord::take_name() {
  const std::vector<std::uint8_t> bytes = take_data();
  const auto printable = [](std::uint8_t character) {
    return character >= 0x20 && character < 0x7F;
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
