// SPDX-License-Identifier: BSD-3-Clause
#include "vtk_window.hpp"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace lockbox {
namespace {

constexpr double kTopOfBackground[] = {0.16, 0.18, 0.22};
constexpr double kBottomOfBackground[] = {0.05, 0.06, 0.08};
constexpr int kSamplesOfPictures = 8;  // a pixel; smooths edges

}  // namespace

VtkWindow::VtkWindow(const std::vector<ScenePart>& parts, const WindowOptions& options)
    : on_loss_(options.on_display_lost),
      title_(options.title),
      model_(parts, *renderer_),
      points_(*renderer_),
      captions_(*renderer_),
      sliders_(*interactor_) {
  renderer_->GradientBackgroundOn();
  renderer_->SetBackground(kBottomOfBackground);
  renderer_->SetBackground2(kTopOfBackground);
  window_->SetMultiSamples(options.visible ? 0 : kSamplesOfPictures);
  window_->SetOffScreenRendering(options.visible ? 0 : 1);
  window_->SetSize(options.width, options.height);
  window_->AddRenderer(renderer_);
  model_.place({}, 1.0);  // where it is, the first scene says
  if (options.visible) listen();
  aim();
  window_->Render();
  window_->SetWindowName(options.title.c_str());
  if (on_loss_) {
    stop_thread_on_loss(static_cast<_XDisplay*>(window_->GetGenericDisplayId()), on_loss_);
  }
}

VtkWindow::~VtkWindow() {
  window_->Finalize();
  // The interactor keeps the connection: without this the window stays on the screen.
  if (auto* const display = static_cast<_XDisplay*>(window_->GetGenericDisplayId())) flush(display);
}

void VtkWindow::listen() {
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style_);
  interactor_->AddObserver(vtkCommand::ExitEvent, this, &VtkWindow::note_exit);
  interactor_->Initialize();
}

void VtkWindow::note_exit() {
  closed_ = true;
}

void VtkWindow::look(const SceneCamera& camera) {
  camera_ = camera;
  aim();
}

void VtkWindow::aim() {
  vtkCamera& view = *renderer_->GetActiveCamera();
  view.SetPosition(camera_.eye.data());
  view.SetFocalPoint(camera_.target.data());
  view.SetViewUp(camera_.up.data());
  view.SetViewAngle(vtkMath::DegreesFromRadians(camera_.view_angle));
}

void VtkWindow::show(const DisplayedScene& scene) {
  points_.set(scene);
  model_.place(scene.T_camera_body, scene.model_opacity);
  captions_.set(scene);
  const bool is_visible = window_->GetOffScreenRendering() == 0;
  if (is_visible) sliders_.set(scene);
  renderer_->ResetCameraClippingRange();
  window_->Render();
  if (is_visible) tell_rate();
}

void VtkWindow::tell_rate() {
  const auto rate = rate_.add();
  if (!rate) return;
  const auto whole = static_cast<int>(std::lround(*rate));
  window_->SetWindowName((title_ + " - " + std::to_string(whole) + " frames/s").c_str());
  tells_rate_ = true;
}

std::vector<std::string> VtkWindow::poll() {
  if (window_->GetOffScreenRendering() != 0) return {};
  if (tells_rate_ && rate_.has_stopped()) {
    window_->SetWindowName(title_.c_str());
    tells_rate_ = false;
  }
  interactor_->ProcessEvents();  // also sends what was said to the display
  auto keys = style_->take_keys();
  if (std::find(keys.begin(), keys.end(), "r") != keys.end()) {
    aim();
    renderer_->ResetCameraClippingRange();
    window_->Render();
  }
  return keys;
}

bool VtkWindow::is_open() const {
  return !closed_;
}

RgbImage VtkWindow::picture() {
  const int* const size = window_->GetSize();
  RgbImage image(size[0], size[1]);
  vtkNew<vtkUnsignedCharArray> pixels;
  const int last_read = 0;  // the back buffer, where the drawing is
  window_->GetPixelData(0, 0, image.width - 1, image.height - 1, last_read, pixels);
  const auto row = static_cast<std::ptrdiff_t>(3) * image.width;
  for (int v = 0; v < image.height; ++v) {  // OpenGL counts rows from the bottom
    std::copy_n(pixels->GetPointer(0) + row * (image.height - 1 - v), row,
                image.rgb.begin() + row * v);
  }
  return image;
}

}  // namespace lockbox
