// SPDX-License-Identifier: BSD-3-Clause
// Would OpenNI2's decoders stay within their buffers, and deliver one whole image?
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace lockbox {

/// What is wrong with a depth image of the codecs `16zT` (with_table) or `16zP`, or nothing.
///
/// 16zT: u16 table size, the table of u16 depths, u16 first index; then bytes. A byte below 0xE0
/// holds two differences of indices (nibble - 6, subtracted), whose second may be 0xD (none) or 0xF
/// (escape); 0xE0 + n repeats the last index 2n times; 0xFF escapes. After an escape, a byte b with
/// its top bit set is the difference b - 192, another begins a big-endian absolute index.
/// 16zP is the same with depths for indices and no table.
std::optional<std::string> find_damage_16z(std::span<const std::uint8_t> payload,
                                           std::size_t pixels, bool with_table);

/// The number of pixels of a depth image of these codecs that is sound, whatever its size; nothing
/// if it is damaged, or larger than the player can hold.
std::optional<std::size_t> sound_pixels_16z(std::span<const std::uint8_t> payload, bool with_table);

/// What is wrong with the segments or the size of a JPEG image, or nothing: the decoder trusts
/// them.
std::optional<std::string> find_damage_jpeg(std::span<const std::uint8_t> payload,
                                            std::size_t pixels);

}  // namespace lockbox
