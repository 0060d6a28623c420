// SPDX-License-Identifier: BSD-3-Clause
#include "component.hpp"

#include <exception>

#include "display.hpp"
#include "vtk_window.hpp"

extern "C" {

__attribute__((visibility("default"))) lockbox::SceneWindow* lockbox_open_window(
    const std::vector<lockbox::ScenePart>& parts, const lockbox::WindowOptions& options,
    std::string& problem) try {
  const lockbox::DisplayConnection display;
  problem = display.problem();
  if (!problem.empty()) return nullptr;
  lockbox::WindowOptions scaled = options;
  if (options.scale <= 0.0) scaled.scale = options.visible ? display.scale() : 1.0;
  return new lockbox::VtkWindow(parts, scaled);
} catch (const std::exception& error) {
  problem = error.what();
  return nullptr;
}
}
