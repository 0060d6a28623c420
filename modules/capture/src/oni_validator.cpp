// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_validator.hpp"

#include <algorithm>
#include <map>

#include "oni_nodes.hpp"
#include "payload_checks.hpp"

namespace lockbox {
namespace {

/// Walks the records like the player, and refuses whatever the player would trip over.
class Validation {
 public:
  explicit Validation(const std::filesystem::path& path)
      : file_(path), header_(read_oni_header(file_)) {
    recording_.file = path;
  }

  OniRecording run() {
    std::uint64_t offset = OniHeader::kSize;
    while (recording_.end == 0) {
      OniRecord record(file_, offset);
      handle(record);
      offset = record.next_offset();
    }
    return finish();
  }

 private:
  void handle(OniRecord& record) {
    if (unready_ != nullptr && record.type() != OniRecordType::state_ready) {
      require_property_of_unready(record);
    }
    switch (record.type()) {
      case OniRecordType::node_added:
        return add_node(record);
      case OniRecordType::int_property:
      case OniRecordType::real_property:
      case OniRecordType::string_property:
      case OniRecordType::general_property:
        return node_of(record).set_property(record);
      case OniRecordType::state_ready:
        record.finish();
        node_of(record).make_ready(record);
        unready_ = nullptr;
        return;
      case OniRecordType::data_begin:
        record.take<std::uint32_t>();
        record.take<std::uint64_t>();
        record.finish();
        data_begun_ = true;
        return node_of(record).begin_data(record);
      case OniRecordType::new_data:
        return add_frame(record);
      case OniRecordType::node_removed:
        record.finish();
        node_of(record);
        removed_.push_back(record.node());
        return;
      case OniRecordType::seek_table:
        return record.finish();
      case OniRecordType::end:
        record.finish();
        recording_.end = record.next_offset();
        return;
    }
    record.refuse("its type is unknown");
  }

  void require_property_of_unready(const OniRecord& record) const {
    const bool is_property = record.type() >= OniRecordType::int_property &&
                             record.type() <= OniRecordType::general_property;
    if (!is_property || record.node() != unready_id_) {
      record.refuse("stream " + unready_->name() + " is not complete yet");
    }
  }

  OniNode& node_of(const OniRecord& record) {
    const auto found = nodes_.find(record.node());
    if (found == nodes_.end() ||
        std::find(removed_.begin(), removed_.end(), record.node()) != removed_.end()) {
      record.refuse("it belongs to stream " + std::to_string(record.node()) +
                    ", which does not exist");
    }
    return found->second;
  }

  void add_node(OniRecord& record) {
    const OniNode node(record);
    const bool taken =
        nodes_.count(record.node()) != 0 ||
        std::any_of(nodes_.begin(), nodes_.end(), [&node](const auto& other) {
          return other.second.name() == node.name() || (node.is_depth() && other.second.is_depth());
        });
    if (taken || data_begun_ || record.node() > header_.maximum_node) {
      record.refuse("stream " + node.name() + " appears twice or too late");
    }
    unready_ = &nodes_.emplace(record.node(), node).first->second;
    unready_id_ = record.node();
  }

  void add_frame(OniRecord& record) {
    OniNode& node = node_of(record);
    const std::uint32_t frame = node.add_frame(record, header_.maximum_timestamp);
    recording_.payloads.push_back({.offset = record.payload_offset(),
                                   .size = record.payload_size(),
                                   .frame = frame,
                                   .codec = node.codec(),
                                   .depth = node.is_depth(),
                                   .pixels = static_cast<std::size_t>(node.width()) *
                                             static_cast<std::size_t>(node.height())});
  }

  OniRecording finish() {
    const auto depth = std::find_if(nodes_.begin(), nodes_.end(),
                                    [](const auto& node) { return node.second.is_depth(); });
    if (depth == nodes_.end()) {
      throw InputError(file_.path().string(),
                       "holds no depth stream; record it again with the depth camera on");
    }
    for (const auto& [id, node] : nodes_) {
      node.check_complete(file_);
    }
    if (depth->second.frame_count() == 0) {
      throw InputError(file_.path().string(), "holds no depth images; record it again");
    }
    recording_.width = depth->second.width();
    recording_.height = depth->second.height();
    recording_.frame_count = depth->second.frame_count();
    recording_.mirrored = depth->second.is_mirrored();
    return std::move(recording_);
  }

  OniFile file_;
  OniHeader header_;
  OniRecording recording_;
  std::map<std::uint32_t, OniNode> nodes_;
  std::vector<std::uint32_t> removed_;
  const OniNode* unready_ = nullptr;  ///< the node whose properties are being read
  std::uint32_t unready_id_ = 0;
  bool data_begun_ = false;
};

}  // namespace

OniRecording validate_oni(const std::filesystem::path& file) {
  return Validation(file).run();
}

OniPayloadChecker::OniPayloadChecker(const OniRecording& recording)
    : recording_(recording), stream_(recording.file, std::ios::binary) {}

void OniPayloadChecker::check_through(std::size_t frame) {
  while (next_ < recording_.payloads.size()) {
    const OniPayload& payload = recording_.payloads[next_];
    if (payload.depth && payload.frame > frame) {
      return;
    }
    check(payload);
    ++next_;
  }
}

void OniPayloadChecker::check(const OniPayload& payload) {
  const std::string_view codec(payload.codec.data(), payload.codec.size());
  buffer_.resize(payload.size);
  stream_.seekg(static_cast<std::streamoff>(payload.offset));
  stream_.read(reinterpret_cast<char*>(buffer_.data()), static_cast<std::streamsize>(payload.size));
  std::optional<std::string> damage;
  if (!stream_) {
    damage = "it cannot be read any more";
  } else if (codec == "JPEG") {
    damage = find_damage_jpeg(buffer_);
  } else if (payload.depth && codec == "NONE") {
    if (buffer_.size() != payload.pixels * 2) {
      damage = "the image has the wrong size";
    }
  } else if (codec != "NONE") {
    damage = find_damage_16z(buffer_, payload.pixels, codec == "16zT");
  }
  if (damage) {
    throw InputError(recording_.file.string(), "frame " + std::to_string(payload.frame) +
                                                   " is damaged, at byte " +
                                                   std::to_string(payload.offset) + ": " + *damage +
                                                   "; copy or record it again");
  }
}

}  // namespace lockbox
