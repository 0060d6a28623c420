// SPDX-License-Identifier: BSD-3-Clause
// A scene around a particular run of states: ready to be drawn.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lockbox/model/states_file.hpp"
#include "lockbox/rendering/depth_renderer.hpp"
#include "lockbox/simulation/scene.hpp"

namespace lockbox {

/// What the pixels of a scene are marked with; those of the model with the number of their body.
inline constexpr std::int16_t kBackgroundId = 10000;
inline constexpr std::int16_t kOccluderId = 10001;

/// Copies share the geometry.
class PlacedScene {
 public:
  /// Makes an empty scene.
  PlacedScene();

  /// Places the scene. The run gives the first base pose and the span of time; it must not be
  /// empty.
  PlacedScene(const Scene& scene, const std::vector<State>& run);

  /// Appends what there is at that state. The items live as long as a copy of the scene.
  void append_items(const State& state, std::vector<RenderItem>& items) const;

 private:
  struct Geometry;
  std::shared_ptr<const Geometry> geometry_;
};

}  // namespace lockbox
