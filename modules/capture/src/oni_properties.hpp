// SPDX-License-Identifier: BSD-3-Clause
// The properties of a .oni file's streams: names with values, as the player takes them.
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "oni_records.hpp"

namespace lockbox {

// Pixel formats of OpenNI2, and of OpenNI 1.
inline constexpr std::uint64_t kMillimetres = 100;
inline constexpr std::uint64_t kTenthsOfMillimetres = 101;
inline constexpr std::uint64_t kRgb = 200;
inline constexpr std::uint64_t kGrey = 202;
inline constexpr std::uint64_t kRgbOfOpenNi1 = 1;
inline constexpr std::uint64_t kGreyOfOpenNi1 = 3;

struct OniProperty {
  std::string name;
  std::vector<std::uint8_t> value;
};

/// Takes the fields of any property record. Throws InputError if the player would trip over them.
OniProperty take_property(OniRecord& record, bool is_depth);

/// Whether it says what the images of its stream mean.
bool decides_interpretation(std::string_view name);

/// Whether this value of oniPixelFormat is a unit of depth.
bool is_depth_format(const std::vector<std::uint8_t>& value);

/// A value of 64 bits.
std::vector<std::uint8_t> whole_number(std::uint64_t number);

template <typename T>
T number_at(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names);

}  // namespace lockbox
