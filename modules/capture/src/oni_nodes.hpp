// SPDX-License-Identifier: BSD-3-Clause
// The nodes (device and streams) that the records of a .oni file build up.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "oni_records.hpp"

namespace lockbox {

class OniNode {
 public:
  /// From a node_added record. Throws InputError for an impossible or unfinished one.
  explicit OniNode(OniRecord& record);

  bool is_stream() const { return type_ != OniNodeType::device; }
  bool is_depth() const { return type_ == OniNodeType::depth; }
  bool is_ready() const { return ready_; }
  const std::string& name() const { return name_; }
  const std::array<char, 4>& codec() const { return codec_; }
  std::uint32_t frame_count() const { return frame_count_; }
  int width() const { return width_; }
  int height() const { return height_; }
  bool is_mirrored() const { return integer("xnMirror", 0) != 0; }

  /// From any property record.
  void set_property(OniRecord& record);

  /// All properties are there: checks those that the player relies upon.
  void make_ready(const OniRecord& record);

  void begin_data(const OniRecord& record);

  /// From a new_data record; returns the frame's number.
  std::uint32_t add_frame(OniRecord& record, std::uint64_t maximum_timestamp);

  /// At the end of the file: all frames are there, and where the seek table says.
  void check_complete(const OniFile& file) const;

 private:
  struct Frame {
    std::uint64_t timestamp;  ///< microseconds
    std::uint64_t record;     ///< offset
  };

  std::uint64_t integer(const char* name, std::uint64_t otherwise) const;
  void check_codec(const OniRecord& record) const;
  void check_property(const OniRecord& record, const std::string& name,
                      const std::vector<std::uint8_t>& value) const;
  void check_mode(const OniRecord& record);
  void check_depth(const OniRecord& record) const;
  void check_seek_table(const OniFile& file) const;

  OniNodeType type_{};
  std::uint32_t id_ = 0;
  std::string name_;
  std::array<char, 4> codec_{};
  std::uint32_t frame_count_ = 0;
  std::uint64_t seek_table_ = 0;  ///< offset, 0 if there is none
  std::map<std::string, std::vector<std::uint8_t>> properties_;
  int width_ = 0;
  int height_ = 0;
  bool ready_ = false;
  bool data_begun_ = false;
  std::vector<Frame> frames_;
};

}  // namespace lockbox
