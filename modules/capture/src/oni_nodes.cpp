// SPDX-License-Identifier: BSD-3-Clause
#include "oni_nodes.hpp"

#include <algorithm>

namespace lockbox {
namespace {

constexpr std::uint32_t kUnfinished = 0xFFFFFFFF;  // frame count until the recorder is closed
constexpr int kMinimumNodeSize = 16;               // pixels
constexpr int kMaximumNodeSize = 4096;
constexpr std::uint64_t kMaximumFrameBytes = 1 << 26;
constexpr std::size_t kSeekEntrySize = 20;  // u64 timestamp, u32 configuration, u64 offset

}  // namespace

OniNode::OniNode(OniRecord& record) : id_(record.node()) {
  name_ = record.take_name();
  type_ = static_cast<OniNodeType>(record.take<std::uint32_t>());
  codec_ = record.take<std::array<char, 4>>();
  if (record.type() != OniRecordType::node_added_1_0_0_4) {
    frame_count_ = record.take<std::uint32_t>();
    record.take<std::uint64_t>();  // first and last timestamp
    record.take<std::uint64_t>();
  }
  if (record.type() == OniRecordType::node_added) {
    seek_table_ = record.take_offset();
  }
  record.finish();
}

bool OniNode::is_finished() const {
  return frame_count_ && *frame_count_ != kUnfinished;
}

bool OniNode::is_playable() const {
  const std::string_view codec(codec_.data(), codec_.size());
  if (is_depth()) {
    return has("xnCropping") && has("xnDeviceMaxDepth");
  }
  if (type_ == OniNodeType::image && codec == "JPEG") {
    const std::uint64_t decoded =
        std::uint64_t{3} * static_cast<unsigned>(width_) * static_cast<unsigned>(height_);
    const std::uint64_t old_format = integer("xnPixelFormat", kRgbOfOpenNi1);
    const std::uint64_t format = integer("oniPixelFormat", kRgb);
    return decoded <= kOniPlayerImage &&
           ((old_format == kRgbOfOpenNi1 && format == kRgb) ||
            (old_format == kGreyOfOpenNi1 && (format == kGrey || !has("oniPixelFormat"))));
  }
  return !is_stream() ||
         ((type_ == OniNodeType::image || type_ == OniNodeType::infrared) && codec == "NONE");
}

void OniNode::check_codec(const OniRecord& record) const {
  if (!is_one_of({codec_.data(), codec_.size()}, {"16zT", "16zP", "NONE"})) {
    record.refuse("the depth images are in an unknown encoding");
  }
}

bool OniNode::set_property(OniRecord& record) {
  const OniProperty property = take_property(record, is_depth());
  if (!decides_interpretation(property.name)) {
    return true;
  }
  if (!ready_ || property.name == "xnMirror") {
    keep(property);
    return true;
  }
  const bool is_reset = is_depth() && property.name == "xnPixelFormat";
  const auto old = properties_.find(property.name);
  const bool is_change = is_reset || old == properties_.end() || old->second != property.value;
  return !is_change || (is_depth() && follow_change(record, property));
}

/// Follows a change as the player does, which takes the room for images and the greatest depth from
/// the beginning.
bool OniNode::follow_change(const OniRecord& record, const OniProperty& property) {
  const std::string& name = property.name;
  if (is_one_of(name, {"oniRequiredFrameSize", "RequiredDataSize", "xnDeviceMaxDepth"})) {
    return true;
  }
  if (!is_one_of(name, {"xnCropping", "xnMapOutputMode", "xnPixelFormat", "oniPixelFormat"}) ||
      (name == "oniPixelFormat" && !is_depth_format(property.value))) {
    return false;
  }
  keep(property);
  if (name == "xnMapOutputMode") {
    check_mode(record);
  }
  return true;
}

/// Keeps the property. To the player, the pixel format of OpenNI 1 says that depth is in
/// millimetres, until that of OpenNI2 comes.
void OniNode::keep(const OniProperty& property) {
  if (is_depth() && property.name == "xnPixelFormat") {
    properties_["oniPixelFormat"] = whole_number(kMillimetres);
  }
  properties_[property.name] = property.value;
}

std::uint64_t OniNode::integer(const char* name, std::uint64_t otherwise) const {
  const auto found = properties_.find(name);
  return found == properties_.end() ? otherwise : number_at<std::uint64_t>(found->second, 0);
}

void OniNode::make_ready(const OniRecord& record) {
  if (ready_ || removed_) {
    record.refuse("stream " + name_ + " becomes ready twice");
  }
  if (is_stream()) {
    check_mode(record);
  }
  if (is_depth()) {
    check_depth(record);
    check_cropping(record);
  }
  check_room(record);
  ready_ = true;
}

void OniNode::check_mode(const OniRecord& record) {
  const auto mode = properties_.find("xnMapOutputMode");
  if (mode == properties_.end()) {
    record.refuse("stream " + name_ + " has no image size");
  }
  const auto width = number_at<std::uint32_t>(mode->second, 0);
  const auto height = number_at<std::uint32_t>(mode->second, 4);
  if (width < kMinimumNodeSize || width > kMaximumNodeSize || height < kMinimumNodeSize ||
      height > kMaximumNodeSize) {
    record.refuse("stream " + name_ + " has images of " + std::to_string(width) + "x" +
                  std::to_string(height) + " pixels");
  }
  width_ = static_cast<int>(width);
  height_ = static_cast<int>(height);
  if (is_depth() && std::uint64_t{width} * height * 2 > kOniPlayerImage) {
    record.refuse("the depth images of " + std::to_string(width) + "x" + std::to_string(height) +
                  " pixels are too large for OpenNI2");
  }
}

std::uint64_t OniNode::image_bytes() const {
  return is_depth() ? image().recorded_pixels() * sizeof(std::uint16_t) : 0;
}

bool OniNode::has_room_for_image() const {
  return image_bytes() <= room_;
}

void OniNode::check_room(const OniRecord& record) {
  const std::uint64_t needed = image_bytes();
  room_ = std::uint64_t{2} * static_cast<unsigned>(width_) * static_cast<unsigned>(height_);
  for (const char* const size : {"RequiredDataSize", "oniRequiredFrameSize"}) {
    const std::uint64_t given = integer(size, room_);
    room_ = std::min(given, room_);
    if (given < needed || given > kMaximumFrameBytes) {
      record.refuse("the frame buffer of stream " + name_ + " has an impossible size");
    }
  }
}

void OniNode::check_depth(const OniRecord& record) const {
  const auto format = properties_.find("oniPixelFormat");
  if (format != properties_.end() && !is_depth_format(format->second)) {
    record.refuse("the depth images are in a unit other than 1 mm or 0.1 mm");
  }
  const std::uint64_t maximum = integer("xnDeviceMaxDepth", 65535);
  if (maximum < 1 || maximum > 65535) {
    record.refuse("the greatest depth is impossible");
  }
}

OniImage OniNode::image() const {
  OniImage image{.width = width_,
                 .height = height_,
                 .mirrored = integer("xnMirror", 0) != 0,
                 .recorded_width = width_,
                 .recorded_height = height_};
  const auto cropping = properties_.find("xnCropping");
  if (is_depth() && cropping != properties_.end() &&
      number_at<std::uint32_t>(cropping->second, 0) != 0) {
    image.left = number_at<std::uint16_t>(cropping->second, 4);
    image.top = number_at<std::uint16_t>(cropping->second, 6);
    image.recorded_width = number_at<std::uint16_t>(cropping->second, 8);
    image.recorded_height = number_at<std::uint16_t>(cropping->second, 10);
  }
  return image;
}

void OniNode::check_cropping(const OniRecord& record) const {
  const OniImage whole = image();
  if (whole.recorded_pixels() == 0 || whole.left + whole.recorded_width > whole.width ||
      whole.top + whole.recorded_height > whole.height) {
    record.refuse("the depth images are cropped to what lies outside of them");
  }
}

void OniNode::begin_data(const OniRecord& record) {
  if (!is_stream() || !ready_ || removed_) {
    record.refuse("frames begin before their stream");
  }
  data_begun_ = true;
}

const OniNode::Frame& OniNode::add_frame(OniRecord& record) {
  const auto timestamp = record.take<std::uint64_t>();
  const auto frame = record.take<std::uint32_t>();
  record.finish();
  if (!data_begun_ || removed_) {
    record.refuse("a frame comes outside of its stream");
  }
  if (frame != frames_.size() + 1) {
    record.refuse("frame " + std::to_string(frame) + " follows frame " +
                  std::to_string(frames_.size()) + " in stream " + name_);
  }
  check_cropping(record);
  return frames_.emplace_back(Frame{timestamp, record.offset()});
}

void OniNode::remove(const OniRecord& record) {
  record.finish();
  if (removed_) {
    record.refuse("stream " + name_ + " ends twice");
  }
  removed_ = true;
}

void OniNode::check_complete(const OniFile& file, const OniHeader& header) const {
  if (!ready_) {
    file.refuse(0, "stream " + name_ + " is not complete");
  }
  if (is_stream() && is_finished() && frames_.size() != *frame_count_) {
    file.refuse(0, "stream " + name_ + " has " + std::to_string(frames_.size()) +
                       " frames instead of " + std::to_string(*frame_count_));
  }
  if (id_ > header.maximum_node) {
    file.refuse(0, "stream " + name_ + " has the number " + std::to_string(id_) + " of " +
                       std::to_string(header.maximum_node));
  }
  for (const Frame& frame : frames_) {
    if (is_finished() && frame.timestamp > header.maximum_timestamp) {
      file.refuse(frame.record, "a frame is later than the recording's end");
    }
  }
}

void OniNode::check_seek_table(const OniFile& file, const OniHeader& header) const {
  if (!is_stream() || frames_.empty() || seek_table_ == 0) {
    return;
  }
  if (seek_table_ < OniHeader::kSize || seek_table_ >= file.size()) {
    file.refuse(0, "the seek table of stream " + name_ + " is outside the file");
  }
  const OniRecord table(file, header, seek_table_);
  if (table.type() != OniRecordType::seek_table || table.node() != id_ ||
      table.payload_size() != kSeekEntrySize * (frames_.size() + 1) ||
      table.next_offset() - table.offset() > kOniPlayerRecord) {
    table.refuse("it is not the seek table of stream " + name_);
  }
  std::vector<std::uint8_t> entries(table.payload_size());
  file.read(table.payload_offset(), entries.data(), entries.size());
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const std::size_t entry = kSeekEntrySize * (i + 1);
    if (number_at<std::uint64_t>(entries, entry) != frames_[i].timestamp ||
        number_at<std::uint64_t>(entries, entry + 12) != frames_[i].record) {
      table.refuse("the seek table does not agree with frame " + std::to_string(i + 1));
    }
  }
}

}  // namespace lockbox
