// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include "display.hpp"
#include "frame_rate.hpp"
#include "help_panel.hpp"
#include "key_style.hpp"
#include "lockbox/visualization/scene_window.hpp"
#include "scene_pane.hpp"
#include "sliders.hpp"

namespace lockbox {

class VtkWindow : public SceneWindow {
 public:
  /// window: new, of VTK. options: with a scale.
  VtkWindow(vtkSmartPointer<vtkRenderWindow> window, const std::vector<ScenePart>& parts,
            const WindowOptions& options);
  ~VtkWindow() override;

  void look(const SceneCamera& camera) override;
  void show(const DisplayedScene& scene) override;
  void show_beside(const DisplayedScene& left, const DisplayedScene& right) override;
  std::vector<std::string> poll() override;
  std::vector<SliderMove> take_moves() override { return sliders_.take_moves(); }
  bool is_open() const override;
  RgbImage picture() override;

 private:
  void aim();
  void choose_size(const WindowOptions& options);
  void split(bool is_split);
  void draw(const DisplayedScene& with_sliders, const std::string& overlay);
  void reset_clipping();
  void listen();
  void note_exit();
  void tell_rate(FrameRate::Clock::time_point begun);

  const std::function<void()> on_loss_;
  const std::string title_;
  FrameRate rate_;
  bool tells_rate_ = false;
  SceneCamera camera_;
  bool closed_ = false;
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<KeyStyle> style_;
  ScenePane left_;
  ScenePane right_;  ///< in the window only where two scenes are shown
  bool is_split_ = false;
  vtkNew<vtkRenderer> front_;  ///< over all of the window
  Sliders sliders_;
  HelpPanel help_;
};

}  // namespace lockbox
