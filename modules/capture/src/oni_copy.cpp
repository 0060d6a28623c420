// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "lockbox/capture/oni_validator.hpp"
#include "oni_properties.hpp"
#include "oni_records.hpp"

namespace lockbox {
namespace {

constexpr std::uint32_t kNode = 1;
constexpr std::uint64_t kAnyTime = std::numeric_limits<std::uint64_t>::max();

/// The fields of a record, as they stand in the file.
class Fields {
 public:
  template <typename T>
  Fields& add(const T& value) {
    const auto* const bytes = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
    return *this;
  }

  Fields& add_data(const void* data, std::size_t size) {
    add(static_cast<std::uint32_t>(size));
    const auto* const bytes = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), bytes, bytes + size);
    return *this;
  }

  Fields& add_name(const std::string& name) { return add_data(name.c_str(), name.size() + 1); }

  const std::vector<char>& bytes() const { return bytes_; }

 private:
  std::vector<char> bytes_;
};

class CopyWriter {
 public:
  explicit CopyWriter(const std::filesystem::path& copy) : out_(copy, std::ios::binary) {
    Fields header;
    header.add(std::array{'N', 'I', '1', '0'});
    header.add(std::array<std::uint8_t, 8>{1, 0, 1, 0, 0, 0, 0, 0});
    header.add(kAnyTime).add(kNode);
    write(header.bytes());
  }

  void add(OniRecordType type, const Fields& fields, const std::vector<char>& payload = {}) {
    constexpr std::uint32_t kHeaderSize = 28;
    Fields record;
    record.add(std::array{'N', 'I', 'R', '\0'}).add(type).add(kNode);
    record.add(kHeaderSize + static_cast<std::uint32_t>(fields.bytes().size()));
    record.add(static_cast<std::uint32_t>(payload.size()));
    record.add(std::uint64_t{0});  // the record before, for seeking
    write(record.bytes());
    write(fields.bytes());
    write(payload);
  }

  void add_property(const std::string& name, const std::vector<std::uint8_t>& value) {
    const bool is_number = value.size() == sizeof(std::uint64_t);
    Fields fields;
    add(is_number ? OniRecordType::int_property : OniRecordType::general_property,
        fields.add_name(name).add_data(value.data(), value.size()));
  }

  bool has_room() const { return bool{out_}; }
  bool is_complete() { return bool{out_.flush()}; }

 private:
  void write(const std::vector<char>& bytes) {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  std::ofstream out_;
};

/// Bytes of the largest depth image.
std::uint64_t frame_room(const OniRecording& recording) {
  std::uint64_t most = 0;
  for (const OniImage& image : recording.images) {
    most =
        std::max<std::uint64_t>(most, sizeof(std::uint16_t) * static_cast<unsigned>(image.width) *
                                          static_cast<unsigned>(image.height));
  }
  return most;
}

/// Adds the properties in the order that the player needs: the size of the images first. The pixel
/// format of OpenNI 1 would reset that of OpenNI2.
void add_properties(const OniRecording& recording, CopyWriter& writer) {
  constexpr std::size_t kCroppingSize = 12;
  constexpr std::uint64_t kGreatestDepth = 65535;
  std::map<std::string, std::vector<std::uint8_t>> properties = recording.depth_properties;
  properties.try_emplace("xnCropping", kCroppingSize);
  properties.try_emplace("xnDeviceMaxDepth", whole_number(kGreatestDepth));
  properties["oniRequiredFrameSize"] = whole_number(frame_room(recording));
  properties.erase("RequiredDataSize");
  properties.erase("xnPixelFormat");
  const auto mode = properties.extract("xnMapOutputMode");
  writer.add_property(mode.key(), mode.mapped());
  for (const auto& [name, value] : properties) {
    writer.add_property(name, value);
  }
}

void add_frames(const OniRecording& recording, CopyWriter& writer) {
  std::ifstream in(recording.file, std::ios::binary);
  std::vector<char> image;
  std::uint32_t number = 0;
  auto change = recording.depth_changes.begin();
  for (const OniPayload& payload : recording.payloads) {
    if (payload.depth && writer.has_room()) {
      for (; change != recording.depth_changes.end() && change->frame <= number; ++change) {
        writer.add_property(change->name, change->value);
      }
      image.resize(payload.size);
      in.seekg(static_cast<std::streamoff>(payload.offset));
      in.read(image.data(), static_cast<std::streamsize>(image.size()));
      Fields fields;
      writer.add(OniRecordType::new_data, fields.add(payload.timestamp).add(++number), image);
    }
  }
}

}  // namespace

void copy_depth(const OniRecording& recording, const std::filesystem::path& copy) {
  CopyWriter writer(copy);
  Fields node;
  node.add_name("Depth").add(OniNodeType::depth).add(recording.payloads.front().codec);
  node.add(static_cast<std::uint32_t>(recording.frame_count));
  node.add(std::uint64_t{0}).add(kAnyTime).add(std::uint64_t{0});  // times, seek table
  writer.add(OniRecordType::node_added, node);
  add_properties(recording, writer);
  writer.add(OniRecordType::state_ready, {});
  Fields begin;
  writer.add(OniRecordType::data_begin,
             begin.add(static_cast<std::uint32_t>(recording.frame_count)).add(kAnyTime));
  add_frames(recording, writer);
  writer.add(OniRecordType::node_removed, {});
  writer.add(OniRecordType::end, {});
  if (!writer.is_complete()) {
    throw InputError(copy.string(), "there is no room for a copy of the depth of " +
                                        recording.file.string() +
                                        ", which OpenNI2 cannot play as it is; set TMPDIR to a "
                                        "folder with more room");
  }
}

}  // namespace lockbox
