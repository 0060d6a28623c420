// SPDX-License-Identifier: BSD-3-Clause
// The largest image that any reader takes, asked before memory is taken for one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace lockbox {

/// Pixels along a side: more is a typing error, or a damaged header.
inline constexpr int kMaximumImageSize = 16384;

/// Pixels of an image, 4096 x 4096: three times as many as the finest depth cameras have (Zivid 2+,
/// 5 megapixels). A frame of so many takes 32 MB; each doubling doubles all that is kept a pixel.
inline constexpr std::size_t kMaximumImagePixels = std::size_t{1} << 24U;

/// Whether these are the width and height of an image that is read.
constexpr bool is_image_size(std::uint64_t width, std::uint64_t height) {
  return width >= 1 && height >= 1 && width <= std::uint64_t{kMaximumImageSize} &&
         height <= std::uint64_t{kMaximumImageSize} && width * height <= kMaximumImagePixels;
}

/// For messages: `640x480`.
template <typename Whole>
std::string size_text(Whole width, Whole height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace lockbox
