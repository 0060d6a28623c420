// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkObject.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <vector>

#include "lockbox/visualization/scene_window.hpp"

namespace lockbox {

/// The sliders of a scene, which the mouse moves: a column on the left, and the seek bar at the
/// bottom.
class Sliders {
 public:
  /// renderer: which draws them, and extends over the whole window. scale: of their texts.
  Sliders(vtkRenderWindowInteractor& interactor, vtkRenderer& renderer, double scale)
      : interactor_(interactor), renderer_(renderer), scale_(scale) {}
  Sliders(const Sliders&) = delete;
  Sliders& operator=(const Sliders&) = delete;

  void set(const DisplayedScene& scene);

  /// What the user has moved since the last call.
  std::vector<SliderMove> take_moves();

 private:
  struct Handle {
    vtkSmartPointer<vtkSliderWidget> widget;
    vtkSmartPointer<vtkSliderRepresentation2D> look;
    vtkSmartPointer<vtkTextActor> label;
  };
  /// As shares of the window's width and height.
  struct Place {
    double left;
    double right;
    double height;
    double room;  ///< for the handle and the label below it
  };

  Handle make(const SceneSlider& slider);
  /// Pixels.
  double letters_in(const Place& place, const SceneSlider& slider) const;
  static void update(const Handle& handle, const SceneSlider& slider, const Place& place,
                     double letters);
  void make_all(const DisplayedScene& scene);
  void clear();
  void note(vtkObject* widget, unsigned long event, void* data);

  vtkRenderWindowInteractor& interactor_;
  vtkRenderer& renderer_;
  double scale_;
  std::vector<Handle> column_;
  std::vector<Handle> seek_bar_;  ///< one or none
  std::vector<SliderMove> moves_;
};

}  // namespace lockbox
