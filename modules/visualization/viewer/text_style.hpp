// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <cmath>
#include <string>

#include "component.hpp"

namespace lockbox {

/// How the viewer writes; letters are as wide as kLetterWidth says. size: of the letters, pixels;
/// grey: in [0, 1].
inline void style(vtkTextProperty& look, double size, double grey) {
  look.SetFontFamilyToCourier();
  look.SetFontSize(static_cast<int>(std::lround(size)));
  look.SetColor(grey, grey, grey);
  look.ItalicOff();
  look.BoldOff();
  look.ShadowOff();
  look.SetBackgroundColor(0.05, 0.06, 0.08);
  look.SetBackgroundOpacity(0.5);  // readable over bright points
}

/// Empty lines are not shown.
inline void show(vtkTextActor& text, const std::string& lines) {
  text.SetInput(lines.c_str());
  text.SetVisibility(lines.empty() ? 0 : 1);
}

}  // namespace lockbox
