// SPDX-License-Identifier: BSD-3-Clause
// The nodes (device and streams) that the records of a .oni file build up.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lockbox/capture/oni_validator.hpp"
#include "oni_properties.hpp"
#include "oni_records.hpp"

namespace lockbox {

class OniNode {
 public:
  using Properties = std::map<std::string, std::vector<std::uint8_t>>;

  /// Makes a node from a record of the three kinds of node_added.
  explicit OniNode(OniRecord& record);

  bool is_stream() const { return type_ != OniNodeType::device; }
  bool is_depth() const { return type_ == OniNodeType::depth; }
  bool is_ready() const { return ready_; }
  bool is_removed() const { return removed_; }
  std::uint32_t id() const { return id_; }
  const std::string& name() const { return name_; }
  const std::array<char, 4>& codec() const { return codec_; }
  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(frames_.size()); }

  /// How images lie at this place of the file. Cropping counts for depth only.
  OniImage image() const;

  /// Returns those properties that say what the images mean, at this place of the file.
  const Properties& properties() const { return properties_; }

  /// Has the recorder written the number of frames, which it does at the end?
  bool is_finished() const;

  /// May the player be given this stream? The depth, otherwise sound, may lack what the player
  /// needs; of others it takes a few encodings only. Asked when the node is ready.
  bool is_playable() const;

  /// The player must know how to decode the depth.
  void check_codec(const OniRecord& record) const;

  /// Takes any property record. Returns whether the node is what it was, or has changed into
  /// something that can be followed.
  bool set_property(OniRecord& record);

  /// All properties are there: checks those that the player relies upon.
  void make_ready(const OniRecord& record);

  void begin_data(const OniRecord& record);

  struct Frame {
    std::uint64_t timestamp;  ///< microseconds
    std::uint64_t record;     ///< offset
  };

  /// Takes a new_data record.
  const Frame& add_frame(OniRecord& record);

  /// Whether the player has room for the depth image at this place of the file.
  bool has_room_for_image() const;

  void remove(const OniRecord& record);

  /// Checks at the end mark that all frames are there, and none is later than the header says.
  void check_complete(const OniFile& file, const OniHeader& header) const;

  /// The frames are where the seek table says, and the player can read it.
  void check_seek_table(const OniFile& file, const OniHeader& header) const;

 private:
  std::uint64_t integer(const char* name, std::uint64_t otherwise) const;
  bool has(const char* name) const { return properties_.count(name) != 0; }
  void check_mode(const OniRecord& record);
  void check_room(const OniRecord& record);
  void check_depth(const OniRecord& record) const;
  void check_cropping(const OniRecord& record) const;
  bool follow_change(const OniRecord& record, const OniProperty& property);
  void keep(const OniProperty& property);
  std::uint64_t image_bytes() const;

  OniNodeType type_{};
  std::uint32_t id_ = 0;
  std::string name_;
  std::array<char, 4> codec_{};
  std::optional<std::uint32_t> frame_count_;  ///< as far as the version says
  std::uint64_t seek_table_ = 0;              ///< offset, 0 if there is none
  Properties properties_;
  int width_ = 0;
  int height_ = 0;
  std::uint64_t room_ = 0;  ///< bytes that the player keeps for a depth image
  bool ready_ = false;
  bool data_begun_ = false;
  bool removed_ = false;
  std::vector<Frame> frames_;
};

}  // namespace lockbox
