// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkObject.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>

#include <vector>

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The sliders of a scene, which the mouse moves: a column on the left, and the seek bar at the
/// bottom.
class Sliders {
 public:
  explicit Sliders(vtkRenderWindowInteractor& interactor) : interactor_(interactor) {}
  Sliders(const Sliders&) = delete;
  Sliders& operator=(const Sliders&) = delete;

  void set(const DisplayedScene& scene);

  /// What the user has moved since the last call.
  std::vector<SliderMove> take_moves();

 private:
  struct Handle {
    vtkSmartPointer<vtkSliderWidget> widget;
    vtkSmartPointer<vtkSliderRepresentation2D> look;
  };

  Handle make(const SceneSlider& slider, double left, double right, double height);
  void make_all(const DisplayedScene& scene);
  void note(vtkObject* widget, unsigned long event, void* data);

  vtkRenderWindowInteractor& interactor_;
  std::vector<Handle> column_;
  std::vector<Handle> seek_bar_;  ///< one or none
  std::vector<SliderMove> moves_;
};

}  // namespace lockbox
