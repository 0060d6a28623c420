// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <deque>

#include "captions.hpp"
#include "model_actors.hpp"
#include "point_actor.hpp"

namespace lockbox {

/// A part of a window that shows a scene: all of it, or one half.
class ScenePane {
 public:
  /// scale: of texts and points.
  ScenePane(const std::vector<ScenePart>& parts, double scale);
  ScenePane(const ScenePane&) = delete;
  ScenePane& operator=(const ScenePane&) = delete;

  void set(const DisplayedScene& scene);

  /// From where to where across the window, as shares of its width.
  void extend(double left, double right);

  vtkRenderer& renderer() { return *renderer_; }

 private:
  void set_ghosts(const std::vector<SceneGhost>& ghosts);

  vtkNew<vtkRenderer> renderer_;
  ModelActors model_;
  std::deque<ModelActors> ghosts_;  ///< as many as were ever needed
  PointActor points_;
  Captions captions_;
  double scale_;
};

}  // namespace lockbox
