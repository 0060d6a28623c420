// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <vector>

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The model in a scene: one actor a part.
class ModelActors {
 public:
  ModelActors(const std::vector<ScenePart>& parts, vtkRenderer& renderer);

  /// The parts of another one once more, in one colour (red, green, blue in [0, 1]).
  ModelActors(const ModelActors& shapes, vtkRenderer& renderer, const Eigen::Vector3f& color);
  ModelActors(const ModelActors&) = delete;
  ModelActors& operator=(const ModelActors&) = delete;

  /// Without poses the model is hidden.
  void place(const std::vector<Eigen::Isometry3d>& T_camera_body, double opacity);

  /// By part, three bytes a vertex; empty: its own colour.
  void color(const std::vector<std::vector<std::uint8_t>>& part_rgb);

 private:
  std::vector<vtkSmartPointer<vtkActor>> actors_;
  std::vector<std::size_t> body_of_actor_;
};

}  // namespace lockbox
