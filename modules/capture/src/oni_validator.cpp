// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_validator.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "oni_nodes.hpp"
#include "payload_checks.hpp"

namespace lockbox {
namespace {

/// What is wrong with a payload that the decoder would trip over, or nothing.
std::optional<std::string> find_damage(std::ifstream& file, const OniPayload& payload,
                                       std::vector<std::uint8_t>& buffer) {
  const std::string_view codec(payload.codec.data(), payload.codec.size());
  buffer.resize(payload.size);
  file.seekg(static_cast<std::streamoff>(payload.offset));
  file.read(reinterpret_cast<char*>(buffer.data()), static_cast<std::streamsize>(payload.size));
  if (!file) {
    return "it cannot be read any more";
  }
  if (codec == "JPEG") {
    return find_damage_jpeg(buffer, payload.pixels);
  }
  if (codec != "NONE") {
    return find_damage_16z(buffer, payload.pixels, codec == "16zT");
  }
  if (payload.depth && buffer.size() != payload.pixels * 2) {
    return "the image has the wrong size";
  }
  return std::nullopt;
}

/// Walks the records like the player. It refuses what the depth cannot be told from, and notes
/// whether there is anything that the player would trip over.
class Validation {
 public:
  explicit Validation(const std::filesystem::path& path)
      : file_(path), header_(read_oni_header(file_)) {
    recording_.file = path;
    recording_.is_plain =
        !header_.has_short_offsets && header_.maximum_node != OniHeader::kUnfinished;
    recording_.end = OniHeader::kSize;
  }

  OniRecording run() {
    for (bool at_end = false; !at_end && !recording_.is_cut_off;) {
      if (breaks_off(file_, header_, recording_.end)) {
        recording_.is_cut_off = true;
        recording_.is_plain = false;
      } else {
        OniRecord record(file_, header_, recording_.end);
        at_end = handle(record);
        recording_.end = record.next_offset();
      }
    }
    return finish();
  }

 private:
  /// Returns whether this is the end mark.
  bool handle(OniRecord& record) {
    switch (record.type()) {
      case OniRecordType::end:
        record.finish();
        return true;
      case OniRecordType::node_added:
      case OniRecordType::node_added_1_0_0_4:
      case OniRecordType::node_added_1_0_0_5:
        add_node(record);
        return false;
      default:
        handle_of_node(record);
        return false;
    }
  }

  /// What is wrong with another stream than depth does not matter: the player does not see it.
  void handle_of_node(OniRecord& record) {
    const auto node = nodes_.find(record.node());
    if (node == nodes_.end()) {
      record.refuse("it belongs to stream " + std::to_string(record.node()) +
                    ", which does not exist");
    }
    if (&node->second == depth_) {
      return apply(record, node->second);
    }
    try {
      apply(record, node->second);
    } catch (const InputError&) {
      recording_.is_plain = false;
    }
  }

  void apply(OniRecord& record, OniNode& node) {
    switch (record.type()) {
      case OniRecordType::int_property:
      case OniRecordType::real_property:
      case OniRecordType::string_property:
      case OniRecordType::general_property:
        return node.set_property(record);
      case OniRecordType::state_ready:
        record.finish();
        node.make_ready(record);
        recording_.is_plain = recording_.is_plain && node.is_playable();
        return;
      case OniRecordType::data_begin:
        record.take<std::uint32_t>();
        record.take<std::uint64_t>();
        record.finish();
        data_begun_ = true;
        return node.begin_data(record);
      case OniRecordType::new_data:
        return add_frame(record, node);
      case OniRecordType::node_removed:
        return node.remove(record);
      case OniRecordType::seek_table:
        return record.finish();
      default:
        record.refuse("its type is unknown");
    }
  }

  /// The player reads on from here until the node is ready: other nodes may be added and begin
  /// meanwhile, but their frames would be lost. Nodes that are added later it finds too late.
  void add_node(OniRecord& record) {
    OniNode node(record);
    const auto found = nodes_.find(record.node());
    const bool is_taken = found != nodes_.end();
    const bool is_named_alike =
        std::any_of(nodes_.begin(), nodes_.end(),
                    [&node](const auto& other) { return other.second.name() == node.name(); });
    if (is_taken && &found->second == depth_) {
      record.refuse("stream " + node.name() + " takes the place of the depth stream");
    }
    const bool is_depth = node.is_depth() && depth_ == nullptr;
    if (is_depth) {
      node.check_codec(record);
    }
    if (is_taken || is_named_alike || data_begun_ || (node.is_depth() && !is_depth)) {
      recording_.is_plain = false;
    }
    OniNode& added = nodes_.insert_or_assign(record.node(), std::move(node)).first->second;
    if (is_depth) {
      depth_ = &added;
    }
  }

  void add_frame(OniRecord& record, OniNode& node) {
    const OniNode::Frame& frame = node.add_frame(record);
    if (std::any_of(nodes_.begin(), nodes_.end(),
                    [](const auto& other) { return !other.second.is_ready(); })) {
      recording_.is_plain = false;
    }
    if (&node == depth_) {
      recording_.mirrored.push_back(node.is_mirrored());
    }
    recording_.payloads.push_back({.offset = record.payload_offset(),
                                   .size = record.payload_size(),
                                   .frame = node.frame_count(),
                                   .timestamp = frame.timestamp,
                                   .codec = node.codec(),
                                   .depth = &node == depth_,
                                   .pixels = static_cast<std::size_t>(node.width()) *
                                             static_cast<std::size_t>(node.height())});
  }

  OniRecording finish() {
    if (recording_.is_cut_off) {
      drop_damaged_end();
    } else {
      check_complete();
    }
    if (!recording_.is_plain) {
      leave_out_other_streams(recording_);
    }
    recording_.frame_count = static_cast<std::size_t>(
        std::count_if(recording_.payloads.begin(), recording_.payloads.end(),
                      [](const OniPayload& payload) { return payload.depth; }));
    require_depth();
    recording_.width = depth_->width();
    recording_.height = depth_->height();
    recording_.mirrored.resize(recording_.frame_count);
    recording_.depth_properties = depth_->deciding_properties();
    return std::move(recording_);
  }

  void require_depth() const {
    const std::string file = file_.path().string();
    if (recording_.is_cut_off && recording_.frame_count == 0) {
      throw InputError(file,
                       "is truncated or unfinished: it breaks off at byte " +
                           std::to_string(recording_.end) +
                           ", before its first complete depth image; copy or record it again");
    }
    if (depth_ == nullptr) {
      throw InputError(file, "holds no depth stream; record it again with the depth camera on");
    }
    if (recording_.frame_count == 0) {
      throw InputError(file, "holds no depth images; record it again");
    }
  }

  /// What was written last may not have reached the disk.
  void drop_damaged_end() {
    std::ifstream stream(recording_.file, std::ios::binary);
    std::vector<std::uint8_t> buffer;
    std::vector<OniPayload>& payloads = recording_.payloads;
    while (!payloads.empty() &&
           (!payloads.back().depth || find_damage(stream, payloads.back(), buffer))) {
      payloads.pop_back();
    }
  }

  void check_complete() {
    for (const auto& [id, node] : nodes_) {
      try {
        node.check_complete(file_, header_);
      } catch (const InputError&) {
        if (&node == depth_) {
          throw;
        }
        recording_.is_plain = false;
      }
      recording_.is_plain = recording_.is_plain && (!node.is_stream() || node.is_finished()) &&
                            has_sound_seek_table(node);
    }
  }

  bool has_sound_seek_table(const OniNode& node) const {
    try {
      node.check_seek_table(file_, header_);
    } catch (const InputError&) {
      return false;
    }
    return true;
  }

  OniFile file_;
  OniHeader header_;
  OniRecording recording_;
  std::map<std::uint32_t, OniNode> nodes_;
  const OniNode* depth_ = nullptr;  ///< the first, which the player takes
  bool data_begun_ = false;
};

}  // namespace

OniRecording validate_oni(const std::filesystem::path& file) {
  return Validation(file).run();
}

void leave_out_other_streams(OniRecording& recording) {
  recording.is_plain = false;
  std::erase_if(recording.payloads, [](const OniPayload& payload) { return !payload.depth; });
}

OniPayloadChecker::OniPayloadChecker(const OniRecording& recording)
    : recording_(recording), stream_(recording.file, std::ios::binary) {}

bool OniPayloadChecker::check_through(std::size_t frame) {
  for (; next_ < recording_.payloads.size(); ++next_) {
    const OniPayload& payload = recording_.payloads[next_];
    if (payload.depth && payload.frame > frame) {
      return true;
    }
    const std::optional<std::string> damage = find_damage(stream_, payload, buffer_);
    if (damage && payload.depth) {
      throw InputError(recording_.file.string(), "frame " + std::to_string(payload.frame) +
                                                     " is damaged, at byte " +
                                                     std::to_string(payload.offset) + ": " +
                                                     *damage + "; copy or record it again");
    }
    if (damage) {
      return false;
    }
  }
  return true;
}

}  // namespace lockbox
