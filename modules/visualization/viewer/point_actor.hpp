// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The coloured points of a scene.
class PointActor {
 public:
  explicit PointActor(vtkRenderer& renderer);

  /// scale: of the points' size.
  void set(const DisplayedScene& scene, double scale);

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkUnsignedCharArray> colors_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkActor> actor_;
};

}  // namespace lockbox
