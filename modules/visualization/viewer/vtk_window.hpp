// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include "captions.hpp"
#include "display.hpp"
#include "frame_rate.hpp"
#include "key_style.hpp"
#include "lockbox/visualization/scene_window.hpp"
#include "model_actors.hpp"
#include "point_actor.hpp"
#include "sliders.hpp"

namespace lockbox {

class VtkWindow : public SceneWindow {
 public:
  VtkWindow(const std::vector<ScenePart>& parts, const WindowOptions& options);
  ~VtkWindow() override;

  void look(const SceneCamera& camera) override;
  void show(const DisplayedScene& scene) override;
  std::vector<std::string> poll() override;
  std::vector<SliderMove> take_moves() override { return sliders_.take_moves(); }
  bool is_open() const override;
  RgbImage picture() override;

 private:
  void aim();
  void listen();
  void note_exit();
  void tell_rate();

  const std::function<void()> on_loss_;
  const std::string title_;
  FrameRate rate_;
  bool tells_rate_ = false;
  SceneCamera camera_;
  bool closed_ = false;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<KeyStyle> style_;
  ModelActors model_;
  PointActor points_;
  Captions captions_;
  Sliders sliders_;
};

}  // namespace lockbox
