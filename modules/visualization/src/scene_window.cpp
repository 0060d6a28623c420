// SPDX-License-Identifier: BSD-3-Clause
#include "lockbox/visualization/scene_window.hpp"

#include "../viewer/component.hpp"
#include "lockbox/core/component.hpp"
#include "lockbox/core/error.hpp"

namespace lockbox {
namespace {

constexpr char kHere = 0;  // its address is in this library

}  // namespace

std::unique_ptr<SceneWindow> open_scene_window(const std::vector<ScenePart>& parts,
                                               const WindowOptions& options) {
  const auto component = find_component(kViewerComponent, &kHere);
  auto* const open = reinterpret_cast<OpenWindow*>(find_symbol(component, kOpenWindow));
  std::string problem;
  std::unique_ptr<SceneWindow> window(open(parts, options, problem));
  if (!window) throw InputError("the 3D viewer", problem);
  return window;
}

}  // namespace lockbox
