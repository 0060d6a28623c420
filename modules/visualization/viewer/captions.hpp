// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextActor.h>

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The text of a scene, and its colour scale.
class Captions {
 public:
  explicit Captions(vtkRenderer& renderer);

  void set(const DisplayedScene& scene);

 private:
  void set_scale(const DisplayedScene& scene);

  vtkNew<vtkTextActor> status_;
  vtkNew<vtkTextActor> help_;
  vtkNew<vtkTextActor> overlay_;
  vtkNew<vtkScalarBarActor> scale_;
};

}  // namespace lockbox
