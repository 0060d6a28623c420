// SPDX-License-Identifier: BSD-3-Clause
#include "ply_body.hpp"

#include <cmath>

#include "binary_number.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {

TextPlyBody::TextPlyBody(const std::string& file, const PlyHeader& header)
    : file_(file), lines_(header.body), header_lines_(header.lines) {}

std::size_t TextPlyBody::least_bytes(const PlyElement& element) {
  return 2 * element.properties.size();
}

void TextPlyBody::begin_element() {
  if (!take_word(rest_).empty()) {
    refuse("there are more numbers than the header says");
  }
}

double TextPlyBody::value(PlyType) {
  const std::string_view word = next_word();
  return finite_number(word, file_, header_lines_ + lines_.number());
}

void TextPlyBody::skip(PlyType, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) next_word();
}

void TextPlyBody::refuse(const std::string& problem) const {
  throw InputError(file_, header_lines_ + lines_.number(), problem);
}

std::string_view TextPlyBody::next_word() {
  while (true) {
    const std::string_view word = take_word(rest_);
    if (!word.empty()) return word;
    if (!lines_.next()) refuse("the file ends before its last element: it is truncated");
    rest_ = lines_.text();
  }
}

BinaryPlyBody::BinaryPlyBody(const std::string& file, const PlyHeader& header)
    : file_(file), order_(*header.binary), whole_(header.body), rest_(header.body) {}

std::size_t BinaryPlyBody::least_bytes(const PlyElement& element) {
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += bytes_of(property.count_type.value_or(property.type));
  }
  return bytes;
}

double BinaryPlyBody::value(PlyType type) {
  const std::string_view bytes = take(bytes_of(type));
  const auto number = [&]<typename T>(T) {
    return static_cast<double>(binary_number<T>(bytes, order_));
  };
  switch (type) {
    case PlyType::int8:
      return number(std::int8_t{});
    case PlyType::uint8:
      return number(std::uint8_t{});
    case PlyType::int16:
      return number(std::int16_t{});
    case PlyType::uint16:
      return number(std::uint16_t{});
    case PlyType::int32:
      return number(std::int32_t{});
    case PlyType::uint32:
      return number(std::uint32_t{});
    case PlyType::float32:
      return number(float{});
    case PlyType::float64:
      break;
  }
  return number(double{});
}

void BinaryPlyBody::skip(PlyType type, std::size_t count) {
  take(bytes_of(type) * count);
}

void BinaryPlyBody::refuse(const std::string& problem) const {
  throw InputError(file_, problem + " (before byte " +
                              std::to_string(whole_.size() - rest_.size()) + " of its elements)");
}

std::string_view BinaryPlyBody::take(std::size_t bytes) {
  if (bytes > rest_.size()) {
    refuse("the file ends before its last element: it is truncated or garbled");
  }
  const std::string_view before = rest_;
  rest_.remove_prefix(bytes);
  return before;
}

}  // namespace lockbox
