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

#include "oni_records.hpp"

namespace lockbox {

class OniNode {
 public:
  using Properties = std::map<std::string, std::vector<std::uint8_t>>;

  /// From a record of the three kinds of node_added.
  explicit OniNode(OniRecord& record);

  bool is_stream() const { return type_ != OniNodeType::device; }
  bool is_depth() const { return type_ == OniNodeType::depth; }
  bool is_ready() const { return ready_; }
  bool is_removed() const { return removed_; }
  std::uint32_t id() const { return id_; }
  const std::string& name() const { return name_; }
  const std::array<char, 4>& codec() const { return codec_; }
  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(frames_.size()); }
  int width() const { return width_; }
  int height() const { return height_; }
  /// At this place of the file.
  bool is_mirrored() const { return integer("xnMirror", 0) != 0; }

  /// Those that say what the images mean.
  Properties deciding_properties() const;

  /// Has the recorder written the number of frames, which it does at the end?
  bool is_finished() const;

  /// May the player be given this stream? The depth, otherwise sound, may lack what the player
  /// needs; of others it takes a few encodings only. Asked when the node is ready.
  bool is_playable() const;

  /// The player must know how to decode the depth.
  void check_codec(const OniRecord& record) const;

  /// From any property record.
  void set_property(OniRecord& record);

  /// All properties are there: checks those that the player relies upon.
  void make_ready(const OniRecord& record);

  void begin_data(const OniRecord& record);

  struct Frame {
    std::uint64_t timestamp;  ///< microseconds
    std::uint64_t record;     ///< offset
  };

  /// From a new_data record.
  const Frame& add_frame(OniRecord& record);

  void remove(const OniRecord& record);

  /// At the end mark: all frames are there, and none is later than the header says.
  void check_complete(const OniFile& file, const OniHeader& header) const;

  /// The frames are where the seek table says, and the player can read it.
  void check_seek_table(const OniFile& file, const OniHeader& header) const;

 private:
  std::uint64_t integer(const char* name, std::uint64_t otherwise) const;
  bool has(const char* name) const { return properties_.count(name) != 0; }
  void check_property(const OniRecord& record, const std::string& name,
                      const std::vector<std::uint8_t>& value) const;
  void check_mode(const OniRecord& record);
  void check_depth(const OniRecord& record) const;

  OniNodeType type_{};
  std::uint32_t id_ = 0;
  std::string name_;
  std::array<char, 4> codec_{};
  std::optional<std::uint32_t> frame_count_;  ///< as far as the version says
  std::uint64_t seek_table_ = 0;              ///< offset, 0 if there is none
  Properties properties_;
  int width_ = 0;
  int height_ = 0;
  bool ready_ = false;
  bool data_begun_ = false;
  bool removed_ = false;
  std::vector<Frame> frames_;
};

}  // namespace lockbox
