// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/captioned_picture.hpp"

#include <algorithm>
#include <cmath>

#include "../viewer/component.hpp"
#include "letters.hpp"
#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr char kHere = 0;  // its address is in this library

constexpr int kSmallestLetters = 13;  // pixels; smaller ones are hard to read
constexpr int kLettersAcross = 80;    // so many times its letters' size a picture is wide
constexpr double kLineStep = 1.35;    // of the letters' size
constexpr int kPatchLetters = 3;      // the patch of a colour, and the gap behind it

/// Where lines and letters are, pixels.
struct Layout {
  explicit Layout(int width)
      : letters(std::max(kSmallestLetters, width / kLettersAcross)),
        letter_width(static_cast<int>(std::ceil(kLetterWidth * letters))),
        step(static_cast<int>(std::lround(kLineStep * letters))),
        margin(letters / 2) {}

  int letters;
  int letter_width;
  int step;
  int margin;
};

/// Draws a patch as high as a capital and as wide as two of them.
void draw_patch(const Eigen::Vector3f& color, int left, int top, const Layout& layout,
                RgbImage& image) {
  const Eigen::Vector3f bytes = 255.0F * color.cwiseMax(0.0F).cwiseMin(1.0F);
  const int height = layout.letters * 3 / 4;
  for (int v = top; v < top + height; ++v) {
    auto byte = image.rgb.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{v} * image.width + left);
    for (int u = 0; u < 2 * layout.letter_width; ++u) {
      for (const float value : bytes) *byte++ = static_cast<std::uint8_t>(std::lround(value));
    }
  }
}

void write(const std::vector<PlacedText>& texts, int letters, RgbImage& image) {
  const auto component = find_component(kViewerComponent, &kHere);
  auto* const write = reinterpret_cast<WriteTexts*>(find_symbol(component, kWriteTexts));
  std::string problem;
  if (!write(texts, letters, image, problem)) throw InputError("texts in pictures", problem);
}

}  // namespace

CaptionRoom room_for(const std::vector<CaptionLine>& lines) {
  CaptionRoom room{lines.size(), 0};
  for (const CaptionLine& line : lines) {
    room.letters = std::max(room.letters, count_letters(line.text));
  }
  return room;
}

RgbImage with_caption(const RgbImage& picture, const std::vector<CaptionLine>& lines,
                      const CaptionRoom& room) {
  const Layout layout(picture.width);
  const int text_at = layout.margin + kPatchLetters * layout.letter_width;
  const int needed = text_at + static_cast<int>(room.letters) * layout.letter_width + layout.margin;
  RgbImage image(std::max(picture.width, needed),
                 picture.height + 2 * layout.margin + static_cast<int>(room.lines) * layout.step,
                 0);
  const auto row = std::ptrdiff_t{3} * picture.width;
  for (int v = 0; v < picture.height; ++v) {
    std::copy_n(picture.rgb.begin() + row * v, row,
                image.rgb.begin() + std::ptrdiff_t{3} * image.width * v);
  }
  const int columns = (image.width - text_at - layout.margin) / layout.letter_width;
  std::vector<PlacedText> texts;
  for (std::size_t i = 0; i < std::min(lines.size(), room.lines); ++i) {
    const int top = picture.height + layout.margin + static_cast<int>(i) * layout.step;
    if (lines[i].color) draw_patch(*lines[i].color, layout.margin, top, layout, image);
    texts.push_back({shortened(lines[i].text, static_cast<std::size_t>(columns)),
                     lines[i].color ? text_at : layout.margin, top});
  }
  write(texts, layout.letters, image);
  return image;
}

}  // namespace lockbox
