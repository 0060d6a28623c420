// SPDX-License-Identifier: BSD-3-Clause
#include "oni_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "field_of_view.hpp"

namespace lockbox {
namespace {

constexpr std::uint32_t kUnfinished = 0xFFFFFFFF;  // frame count until the recorder is closed
constexpr int kMinimumNodeSize = 16;               // pixels
constexpr int kMaximumNodeSize = 4096;
constexpr std::uint64_t kMaximumFrameBytes = 1 << 26;
constexpr std::uint64_t kRgb = 200;  // pixel formats of OpenNI2
constexpr std::uint64_t kGrey = 202;
constexpr std::uint64_t kRgbOfOpenNi1 = 1;
constexpr std::uint64_t kGreyOfOpenNi1 = 3;
constexpr std::size_t kSeekEntrySize = 20;  // u64 timestamp, u32 configuration, u64 offset

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Sizes in bytes of the structures that the player copies without looking; 0 for all others.
std::size_t structure_size(std::string_view name) {
  if (is_one_of(name, {"xnCropping", "xnMapOutputMode"})) {
    return 12;
  }
  if (name == "xnFOV") {
    return 16;
  }
  return name == "xnRealWorldTranslationData" ? 24 : 0;
}

bool decides_interpretation(std::string_view name) {
  return structure_size(name) != 0 ||
         is_one_of(name, {"xnMirror", "xnPixelFormat", "oniPixelFormat", "xnDeviceMaxDepth",
                          "oniRequiredFrameSize", "RequiredDataSize"});
}

bool is_known_format(std::uint64_t format_of_openni1) {
  constexpr std::uint64_t kJpeg = 5;
  return format_of_openni1 >= kRgbOfOpenNi1 && format_of_openni1 <= kJpeg;
}

/// Takes the value of a property record and checks its form.
std::vector<std::uint8_t> take_value(OniRecord& record) {
  std::vector<std::uint8_t> value = record.take_data();
  const bool is_number =
      record.type() == OniRecordType::int_property || record.type() == OniRecordType::real_property;
  if (is_number && value.size() != 8) {
    record.refuse("a number has " + std::to_string(value.size()) + " bytes instead of 8");
  }
  if (record.type() == OniRecordType::string_property && (value.empty() || value.back() != 0)) {
    record.refuse("a text has no end");
  }
  record.finish();
  return value;
}

template <typename T>
T number_at(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

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

OniNode::Properties OniNode::deciding_properties() const {
  Properties properties = properties_;
  std::erase_if(properties,
                [](const auto& property) { return !decides_interpretation(property.first); });
  return properties;
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

void OniNode::set_property(OniRecord& record) {
  const std::string name = record.take_name();
  const std::vector<std::uint8_t> value = take_value(record);
  check_property(record, name, value);
  if (!ready_ || name == "xnMirror") {
    properties_[name] = value;
  } else if (decides_interpretation(name) && properties_[name] != value) {
    record.refuse(name + " changes in the middle of the recording, which is not supported");
  }
}

void OniNode::check_property(const OniRecord& record, const std::string& name,
                             const std::vector<std::uint8_t>& value) const {
  const std::size_t expected = structure_size(name);
  if (expected != 0 &&
      (value.size() != expected || record.type() != OniRecordType::general_property)) {
    record.refuse(name + " has the wrong size");
  }
  if (expected == 0 && decides_interpretation(name) &&
      record.type() != OniRecordType::int_property) {
    record.refuse(name + " is not a whole number");
  }
  if (name == "xnPixelFormat" && !is_depth() &&
      !is_known_format(number_at<std::uint64_t>(value, 0))) {
    record.refuse("the images are in an unknown format");
  }
  if (name == "xnFOV") {
    for (const double angle : {number_at<double>(value, 0), number_at<double>(value, 8)}) {
      if (!(angle >= kMinimumFieldOfView && angle <= kMaximumFieldOfView)) {
        record.refuse("the field of view is impossible");
      }
    }
  }
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
  }
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
  for (const char* const size : {"oniRequiredFrameSize", "RequiredDataSize"}) {
    const std::uint64_t needed = is_depth() ? std::uint64_t{width} * height * 2 : 0;
    const std::uint64_t given = integer(size, needed);
    if (given < needed || given > kMaximumFrameBytes) {
      record.refuse("the frame buffer of stream " + name_ + " has an impossible size");
    }
  }
}

void OniNode::check_depth(const OniRecord& record) const {
  constexpr std::uint64_t kMillimetreFormat = 100;
  constexpr std::uint64_t kTenthsOfMillimetres = 101;
  const std::uint64_t format = integer("oniPixelFormat", kMillimetreFormat);
  if (format != kMillimetreFormat && format != kTenthsOfMillimetres) {
    record.refuse("the depth images are in a unit other than 1 mm or 0.1 mm");
  }
  const std::uint64_t maximum = integer("xnDeviceMaxDepth", 65535);
  if (maximum < 1 || maximum > 65535) {
    record.refuse("the greatest depth is impossible");
  }
  const auto cropping = properties_.find("xnCropping");
  if (cropping != properties_.end() && number_at<std::uint32_t>(cropping->second, 0) != 0) {
    record.refuse("the depth images are cropped, which is not supported; record without cropping");
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
