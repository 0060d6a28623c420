// SPDX-License-Identifier: BSD-3-Clause
#include "oni_properties.hpp"

#include <algorithm>
#include <cmath>

#include "field_of_view.hpp"

namespace lockbox {
namespace {

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

void check_value(const OniRecord& record, const std::string& name,
                 const std::vector<std::uint8_t>& value, bool is_depth) {
  const std::size_t expected = structure_size(name);
  if (expected != 0 &&
      (value.size() != expected || record.type() != OniRecordType::general_property)) {
    record.refuse(name + " has the wrong size");
  }
  if (expected == 0 && decides_interpretation(name) &&
      record.type() != OniRecordType::int_property) {
    record.refuse(name + " is not a whole number");
  }
  if (name == "xnPixelFormat" && !is_depth &&
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

}  // namespace

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool decides_interpretation(std::string_view name) {
  return structure_size(name) != 0 ||
         is_one_of(name, {"xnMirror", "xnPixelFormat", "oniPixelFormat", "xnDeviceMaxDepth",
                          "oniRequiredFrameSize", "RequiredDataSize"});
}

bool is_depth_format(const std::vector<std::uint8_t>& value) {
  const auto format = number_at<std::uint64_t>(value, 0);
  return format == kMillimetres || format == kTenthsOfMillimetres;
}

std::vector<std::uint8_t> whole_number(std::uint64_t number) {
  std::vector<std::uint8_t> bytes(sizeof(number));
  std::memcpy(bytes.data(), &number, sizeof(number));
  return bytes;
}

OniProperty take_property(OniRecord& record, bool is_depth) {
  OniProperty property;
  property.name = record.take_name();
  property.value = take_value(record);
  check_value(record, property.name, property.value, is_depth);
  return property;
}

}  // namespace lockbox
