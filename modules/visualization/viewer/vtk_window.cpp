// SPDX-License-Identifier: BSD-3-Clause
#include "vtk_window.hpp"

#include <vtkBoundingBox.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace lockbox {
namespace {

constexpr int kSamplesOfPictures = 8;   // a pixel; smooths edges
constexpr double kUsualWidth = 1280.0;  // pixels at scale 1
constexpr double kUsualHeight = 800.0;

}  // namespace

VtkWindow::VtkWindow(vtkSmartPointer<vtkRenderWindow> window, const std::vector<ScenePart>& parts,
                     const WindowOptions& options)
    : on_loss_(options.on_display_lost),
      title_(options.title),
      window_(std::move(window)),
      left_(parts, options.scale),
      right_(parts, options.scale),
      sliders_(*interactor_, *front_, options.scale),
      help_(*front_, options.scale) {
  right_.renderer().SetActiveCamera(left_.renderer().GetActiveCamera());
  window_->SetMultiSamples(options.visible ? 0 : kSamplesOfPictures);
  window_->SetOffScreenRendering(options.visible ? 0 : 1);
  choose_size(options);
  window_->AddRenderer(&left_.renderer());
  front_->SetLayer(1);
  front_->InteractiveOff();  // the mouse turns what is behind
  window_->SetNumberOfLayers(2);
  window_->AddRenderer(front_);
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

void VtkWindow::choose_size(const WindowOptions& options) {
  int width = options.width > 0 ? options.width : static_cast<int>(kUsualWidth * options.scale);
  int height = options.height > 0 ? options.height : static_cast<int>(kUsualHeight * options.scale);
  if (options.visible && options.width <= 0) {
    const int* const screen = window_->GetScreenSize();
    width = std::min(width, screen[0]);
    height = std::min(height, screen[1]);
  }
  window_->SetSize(width, height);
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
  vtkCamera& view = *left_.renderer().GetActiveCamera();
  view.SetPosition(camera_.eye.data());
  view.SetFocalPoint(camera_.target.data());
  view.SetViewUp(camera_.up.data());
  view.SetViewAngle(vtkMath::DegreesFromRadians(camera_.view_angle));
}

void VtkWindow::show(const DisplayedScene& scene) {
  split(false);
  left_.set(scene);
  draw(scene, scene.overlay);
}

void VtkWindow::show_beside(const DisplayedScene& left, const DisplayedScene& right) {
  split(true);
  left_.set(left);
  right_.set(right);
  draw(left, left.overlay.empty() ? right.overlay : left.overlay);
}

void VtkWindow::split(bool is_split) {
  if (is_split == is_split_) return;
  is_split_ = is_split;
  left_.extend(0.0, is_split ? 0.5 : 1.0);
  right_.extend(0.5, 1.0);
  if (is_split) {
    window_->AddRenderer(&right_.renderer());
  } else {
    window_->RemoveRenderer(&right_.renderer());
  }
}

/// Both panes have one camera, which has to reach as far as the deeper one needs.
void VtkWindow::reset_clipping() {
  double bounds[6];
  left_.renderer().ComputeVisiblePropBounds(bounds);
  vtkBoundingBox all(bounds);
  if (is_split_) {
    right_.renderer().ComputeVisiblePropBounds(bounds);
    all.AddBounds(bounds);
  }
  if (!all.IsValid()) return;
  all.GetBounds(bounds);
  left_.renderer().ResetCameraClippingRange(bounds);
}

void VtkWindow::draw(const DisplayedScene& with_sliders, const std::string& overlay) {
  const auto begun = FrameRate::Clock::now();
  const bool is_visible = window_->GetOffScreenRendering() == 0;
  help_.set(overlay);
  if (is_visible) sliders_.set(with_sliders);
  reset_clipping();
  window_->Render();
  if (is_visible) tell_rate(begun);
}

void VtkWindow::tell_rate(FrameRate::Clock::time_point begun) {
  const auto rate = rate_.add(begun);
  if (!rate) return;
  constexpr std::size_t kLongest = 32;
  char text[kLongest] = {};
  std::snprintf(text, kLongest, *rate < 5.0 ? "%.1f frames/s" : "%.0f frames/s", *rate);
  window_->SetWindowName((title_ + " - " + text).c_str());
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
    reset_clipping();
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
