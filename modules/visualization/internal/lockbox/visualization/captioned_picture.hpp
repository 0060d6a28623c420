// SPDX-License-Identifier: BSD-3-Clause
// Pictures with lines of text below them. They need no display.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lockbox/visualization/rgb_image.hpp"

namespace lockbox {

struct CaptionLine {
  std::string text;                      ///< UTF-8
  std::optional<Eigen::Vector3f> color;  ///< of the patch before it, in [0, 1]; none: no patch
};

/// How much room there is for a caption, so that all pictures of a series have one size.
struct CaptionRoom {
  std::size_t lines = 0;
  std::size_t letters = 0;  ///< that a line has at least, its patch not counted
};

/// The room that these lines need.
CaptionRoom room_for(const std::vector<CaptionLine>& lines);

/// Letters are the larger the wider the picture is. What does not fit into the room is left out, of
/// a line with three points. Throws InputError if what writes texts is not installed.
RgbImage with_caption(const RgbImage& picture, const std::vector<CaptionLine>& lines,
                      const CaptionRoom& room);

}  // namespace lockbox
