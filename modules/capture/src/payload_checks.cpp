// SPDX-License-Identifier: BSD-3-Clause
#include "payload_checks.hpp"

#include "oni_records.hpp"

namespace lockbox {
namespace {

/// Follows the decoder through one depth image.
class Decoder16z {
 public:
  Decoder16z(std::span<const std::uint8_t> payload, std::size_t pixels, bool with_table)
      : payload_(payload), pixels_(pixels), with_table_(with_table) {}

  std::optional<std::string> find_damage() {
    if (auto damage = decode()) {
      return damage;
    }
    if (count_ != pixels_) {
      return "the image has " + std::to_string(count_) + " pixels instead of " +
             std::to_string(pixels_);
    }
    return std::nullopt;
  }

  /// What is wrong but the number of pixels, as far as these are not too many.
  std::optional<std::string> decode() {
    if (with_table_) {
      const std::uint32_t size = little_endian();
      table_size_ = size;
      position_ += std::size_t{2} * size;
    }
    index_ = little_endian();
    count_ = 1;
    while (position_ < payload_.size() && count_ <= pixels_ && in_range_) {
      step();
      in_range_ = in_range_ && index_ < table_size_;
    }
    if (overrun_ || position_ != payload_.size()) {
      return "the encoded image ends in the middle of a value";
    }
    if (!in_range_ || index_ >= table_size_) {
      return "a pixel refers to a depth outside the table";
    }
    return std::nullopt;
  }

  std::size_t count() const { return count_; }

 private:
  std::uint8_t byte() {
    if (position_ >= payload_.size()) {
      overrun_ = true;
      return 0;
    }
    return payload_[position_++];
  }

  std::uint16_t little_endian() {
    const std::uint8_t low = byte();
    return static_cast<std::uint16_t>(low | byte() << 8);
  }

  void difference(int amount) {
    index_ = static_cast<std::uint16_t>(index_ - amount);
    in_range_ = in_range_ && index_ < table_size_;
    ++count_;
  }

  void escape() {
    const std::uint8_t first = byte();
    if ((first & 0x80) != 0) {
      difference(first - 192);
    } else {
      index_ = static_cast<std::uint16_t>(first << 8 | byte());
      ++count_;
    }
  }

  void step() {
    const std::uint8_t code = byte();
    if (code == 0xFF) {
      escape();
    } else if (code >= 0xE0) {
      count_ += std::size_t{2} * (code - 0xE0U);
    } else {
      difference((code >> 4) - 6);
      const int second = code & 0x0F;
      if (second == 0x0F) {
        escape();
      } else if (second != 0x0D) {
        difference(second - 6);
      }
    }
  }

  std::span<const std::uint8_t> payload_;
  std::size_t pixels_;
  bool with_table_;
  std::size_t position_ = 0;
  std::size_t count_ = 0;
  std::uint32_t table_size_ = 65536;
  std::uint16_t index_ = 0;
  bool overrun_ = false;
  bool in_range_ = true;
};

constexpr bool has_no_length(std::uint8_t marker) {
  return marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8) || marker == 0xFF;
}

constexpr bool begins_image(std::uint8_t marker) {
  constexpr std::uint8_t kTables = 0xC4;
  constexpr std::uint8_t kReserved = 0xC8;
  constexpr std::uint8_t kConditioning = 0xCC;
  return marker >= 0xC0 && marker <= 0xCF && marker != kTables && marker != kReserved &&
         marker != kConditioning;
}

/// Reads the size from the first 9 bytes of a segment that begins an image.
std::size_t image_size(std::span<const std::uint8_t> segment) {
  const std::size_t height = std::size_t{segment[5]} << 8 | segment[6];
  return height * (std::size_t{segment[7]} << 8 | segment[8]);
}

}  // namespace

std::optional<std::string> find_damage_16z(std::span<const std::uint8_t> payload,
                                           std::size_t pixels, bool with_table) {
  return Decoder16z(payload, pixels, with_table).find_damage();
}

std::optional<std::size_t> sound_pixels_16z(std::span<const std::uint8_t> payload,
                                            bool with_table) {
  constexpr std::size_t kMost = kOniPlayerImage / sizeof(std::uint16_t);
  Decoder16z decoder(payload, kMost, with_table);
  const bool is_sound = !decoder.decode() && decoder.count() <= kMost;
  return is_sound ? std::optional(decoder.count()) : std::nullopt;
}

std::optional<std::string> find_damage_jpeg(std::span<const std::uint8_t> payload,
                                            std::size_t pixels) {
  constexpr std::uint8_t kEndOfImage = 0xD9;
  if (payload.size() < 4 || payload[0] != 0xFF || payload[1] != 0xD8) {
    return "is not a JPEG image";
  }
  std::size_t position = 2;
  while (position + 1 < payload.size()) {
    const std::uint8_t marker = payload[position + 1];
    if (payload[position] != 0xFF) {
      ++position;  // entropy-coded data
    } else if (marker == kEndOfImage) {
      return std::nullopt;
    } else if (has_no_length(marker)) {
      position += marker == 0xFF ? 1 : 2;
    } else {
      if (position + 8 >= payload.size()) {
        break;
      }
      if (begins_image(marker) && image_size(payload.subspan(position, 9)) != pixels) {
        return "the JPEG image has another size than its stream";
      }
      position += 2U + (std::size_t{payload[position + 2]} << 8 | payload[position + 3]);
    }
  }
  return "the JPEG image is cut off";
}

}  // namespace lockbox
