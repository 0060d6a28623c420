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
  return new lockbox::VtkWindow(parts, options);
} catch (const std::exception& error) {
  problem = error.what();
  return nullptr;
}
}
