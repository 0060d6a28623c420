// SPDX-License-Identifier: BSD-3-Clause
#include "help_panel.hpp"

#include <vtkCoordinate.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

#include "text_style.hpp"

namespace lockbox {
namespace {

constexpr double kLetters = 16.0;    // pixels at scale 1
constexpr double kFewestPixels = 5;  // of letters; smaller ones cannot be read
constexpr double kRoom = 0.94;       // of the window's width and height, for frame and margin

/// As wide as that on the left, which the lines have by themselves.
std::string with_right_margin(std::string lines) {
  constexpr char kMargin[] = "  ";
  std::size_t end = 0;
  for (std::size_t begin = 0, longest = 0; begin < lines.size();) {
    const std::size_t line_end = std::min(lines.find('\n', begin), lines.size());
    if (line_end - begin > longest) {
      longest = line_end - begin;
      end = line_end;
    }
    begin = line_end + 1;
  }
  if (!lines.empty()) lines.insert(end, kMargin);
  return lines;
}

}  // namespace

HelpPanel::HelpPanel(vtkRenderer& renderer, double scale) : renderer_(renderer), scale_(scale) {
  vtkTextProperty& look = *text_->GetTextProperty();
  style(look, scale * kLetters, 0.95);
  look.SetBackgroundOpacity(0.85);
  look.SetFrame(true);
  look.SetFrameColor(0.5, 0.5, 0.5);
  text_->GetPositionCoordinate()->SetCoordinateSystemToViewport();
  renderer.AddViewProp(text_);
}

void HelpPanel::set(const std::string& lines) {
  show(*text_, with_right_margin(lines));
  if (!lines.empty()) fit();
}

void HelpPanel::fit() {
  const int* const window = renderer_.GetSize();  // pixels
  double size[2] = {};
  double letters = scale_ * kLetters;
  for (;;) {
    text_->GetTextProperty()->SetFontSize(static_cast<int>(letters));
    text_->GetSize(&renderer_, size);
    const double share = std::min(kRoom * window[0] / std::max(size[0], 1.0),
                                  kRoom * window[1] / std::max(size[1], 1.0));
    if (share >= 1.0 || letters <= kFewestPixels) break;
    // Letters have whole pixels: what would fit by its share may be a step too large.
    letters = std::max(kFewestPixels, std::min(std::floor(letters * share), letters - 1.0));
  }
  text_->SetPosition(std::floor(0.5 * (window[0] - size[0])),
                     std::floor(0.5 * (window[1] - size[1])));
}

}  // namespace lockbox
