// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/capture/oni_validator.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "oni_nodes.hpp"
#include "oni_payloads.hpp"

namespace lockbox {
namespace {

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
    for (bool at_end = false; !at_end && !recording_.is_cut_off && depth_end_.empty();) {
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
        return set_property(record, node);
      case OniRecordType::state_ready:
        record.finish();
        node.make_ready(record);
        recording_.is_plain = recording_.is_plain && node.is_playable();
        if (&node == depth_) {
          recording_.depth_properties = node.properties();
        }
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

  void set_property(OniRecord& record, OniNode& node) {
    const OniNode::Properties before = node.properties();
    const bool is_followed = node.set_property(record);
    if (&node != depth_) {
      recording_.is_plain = recording_.is_plain && is_followed;
    } else if (!is_followed) {
      depth_end_ = "from frame " + std::to_string(node.frame_count() + 1) +
                   " on the depth images mean something else (a property changes in the record "
                   "at byte " +
                   std::to_string(record.offset()) + ")";
    } else if (node.is_ready()) {
      note_changes(before, node.properties());
    }
  }

  void note_changes(const OniNode::Properties& before, const OniNode::Properties& after) {
    for (const auto& [name, value] : after) {
      const auto old = before.find(name);
      if (old == before.end() || old->second != value) {
        recording_.depth_changes.push_back({depth_->frame_count(), name, value});
      }
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
    const OniImage image = node.image();
    if (&node == depth_) {
      recording_.images.push_back(image);
      recording_.is_plain = recording_.is_plain && node.has_room_for_image();
    }
    recording_.payloads.push_back({.offset = record.payload_offset(),
                                   .size = record.payload_size(),
                                   .frame = node.frame_count(),
                                   .timestamp = frame.timestamp,
                                   .codec = node.codec(),
                                   .depth = &node == depth_,
                                   .pixels = image.recorded_pixels()});
  }

  OniRecording finish() {
    if (recording_.is_cut_off) {
      drop_damaged_end();
    } else if (depth_end_.empty()) {
      check_complete();
    } else {
      end_early(recording_, recording_.images.size(), depth_end_);
      recording_.is_plain = false;
    }
    if (!recording_.is_plain) {
      leave_out_other_streams(recording_);
    }
    recording_.frame_count = static_cast<std::size_t>(
        std::count_if(recording_.payloads.begin(), recording_.payloads.end(),
                      [](const OniPayload& payload) { return payload.depth; }));
    require_depth();
    recording_.images.resize(recording_.frame_count);
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
  std::string depth_end_;  ///< why depth cannot be followed to the end of the file
};

}  // namespace

OniRecording validate_oni(const std::filesystem::path& file) {
  return Validation(file).run();
}

void leave_out_other_streams(OniRecording& recording) {
  recording.is_plain = false;
  std::erase_if(recording.payloads, [](const OniPayload& payload) { return !payload.depth; });
}

void end_early(OniRecording& recording, std::size_t frame_count, const std::string& reason) {
  if (frame_count == 0) {
    throw InputError(recording.file.string(),
                     reason + "; set up the device before the recorder, and record again");
  }
  const auto end = std::find_if(recording.payloads.begin(), recording.payloads.end(),
                                [frame_count](const OniPayload& payload) {
                                  return payload.depth && payload.frame > frame_count;
                                });
  recording.payloads.erase(end, recording.payloads.end());
  recording.images.resize(frame_count);
  recording.frame_count = frame_count;
  recording.end_reason = reason;
}

}  // namespace lockbox
