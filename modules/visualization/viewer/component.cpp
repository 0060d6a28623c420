// SPDX-License-Identifier: BSD-3-Clause
#include "component.hpp"

#include <exception>
#include <utility>

#include "display.hpp"
#include "offscreen_window.hpp"
#include "vtk_window.hpp"

namespace lockbox {
namespace {

SceneWindow* open_visible(const std::vector<ScenePart>& parts, WindowOptions options,
                          std::string& problem) {
  const DisplayConnection display;
  problem = display.problem();
  if (!problem.empty()) return nullptr;
  if (options.scale <= 0.0) options.scale = display.scale();
  return new VtkWindow(vtkSmartPointer<vtkRenderWindow>::New(), parts, options);
}

/// With the help of an X display only where OpenGL cannot draw without one.
SceneWindow* open_invisible(const std::vector<ScenePart>& parts, WindowOptions options,
                            std::string& problem) {
  if (options.scale <= 0.0) options.scale = 1.0;
  auto context = std::make_unique<OffscreenContext>();
  if (!context->problem().empty()) {
    const std::string reason = context->problem();
    SceneWindow* const window = open_visible(parts, options, problem);
    if (window == nullptr) problem = reason + ", and " + problem;
    return window;
  }
  vtkNew<OffscreenWindow> window;
  window->use(std::move(context));
  return new VtkWindow(window.Get(), parts, options);
}

}  // namespace
}  // namespace lockbox

extern "C" {

__attribute__((visibility("default"))) lockbox::SceneWindow* lockbox_open_window(
    const std::vector<lockbox::ScenePart>& parts, const lockbox::WindowOptions& options,
    std::string& problem) try {
  return options.visible ? lockbox::open_visible(parts, options, problem)
                         : lockbox::open_invisible(parts, options, problem);
} catch (const std::exception& error) {
  problem = error.what();
  return nullptr;
}
}
