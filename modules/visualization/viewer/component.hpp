// SPDX-License-Identifier: BSD-3-Clause
// The face of the component that draws with VTK.
#pragma once

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// What liblockbox_viewer.so exports under kOpenWindow. The caller deletes the window. It returns
/// null, and the reason in problem, if none can be opened: exceptions do not cross the boundary.
using OpenWindow = SceneWindow*(const std::vector<ScenePart>& parts, const WindowOptions& options,
                                std::string& problem);
inline constexpr char kViewerComponent[] = "liblockbox_viewer.so";
inline constexpr char kOpenWindow[] = "lockbox_open_window";

/// A line whose upper left corner is at this pixel.
struct PlacedText {
  std::string text;  ///< UTF-8
  int u;
  int v;
};

/// What it exports under kWriteTexts: writes over a picture, in light grey. letters: their size,
/// pixels. False, and the reason in problem, if it cannot.
using WriteTexts = bool(const std::vector<PlacedText>& texts, int letters, RgbImage& picture,
                        std::string& problem);
inline constexpr char kWriteTexts[] = "lockbox_write_texts";

/// How wide its letters are, as a share of their size.
inline constexpr double kLetterWidth = 0.62;

}  // namespace lockbox
