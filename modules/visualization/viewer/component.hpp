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

}  // namespace lockbox
