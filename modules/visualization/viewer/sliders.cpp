// SPDX-License-Identifier: BSD-3-Clause
#include "sliders.hpp"

#include <vtkCommand.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

namespace lockbox {
namespace {

// Of the window's width and height.
constexpr double kLeft = 0.02;
constexpr double kRight = 0.24;
constexpr double kTop = 0.88;
constexpr double kBottom = 0.1;
constexpr double kFarthestStep = 0.085;  // from one slider to the next
constexpr double kSeekLeft = 0.12;
constexpr double kSeekRight = 0.88;
constexpr double kSeekHeight = 0.06;

void style(vtkTextProperty& look) {
  look.SetFontFamilyToCourier();
  look.SetColor(0.9, 0.9, 0.9);
  look.BoldOff();
  look.ItalicOff();
  look.ShadowOff();
}

void style(vtkSliderRepresentation2D& look) {
  look.GetTubeProperty()->SetColor(0.45, 0.48, 0.55);
  look.GetSliderProperty()->SetColor(0.95, 0.7, 0.25);
  look.GetSelectedProperty()->SetColor(1.0, 0.85, 0.5);
  look.GetCapProperty()->SetColor(0.45, 0.48, 0.55);
  style(*look.GetTitleProperty());
  look.SetEndCapWidth(0.012);
  look.SetEndCapLength(0.004);
  look.SetTubeWidth(0.006);
  look.SetSliderWidth(0.022);
  look.SetSliderLength(0.012);
  look.ShowSliderLabelOff();
  look.SetTitleHeight(0.02);
}

/// "latch  12.0 °"
std::string title_of(const SceneSlider& slider) {
  constexpr std::size_t kLongest = 32;
  char value[kLongest] = {};
  std::snprintf(value, kLongest, slider.format.c_str(), slider.value);
  return slider.name + "  " + value;
}

void update(vtkSliderRepresentation2D& look, const SceneSlider& slider) {
  look.SetValue(std::clamp(slider.value, slider.lower, slider.upper));
  look.SetTitleText(title_of(slider).c_str());
}

}  // namespace

Sliders::Handle Sliders::make(const SceneSlider& slider, double left, double right, double height) {
  Handle handle{vtkSmartPointer<vtkSliderWidget>::New(),
                vtkSmartPointer<vtkSliderRepresentation2D>::New()};
  style(*handle.look);
  handle.look->SetMinimumValue(slider.lower);
  handle.look->SetMaximumValue(slider.upper);
  handle.look->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  handle.look->GetPoint1Coordinate()->SetValue(left, height);
  handle.look->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  handle.look->GetPoint2Coordinate()->SetValue(right, height);
  update(*handle.look, slider);
  handle.widget->SetInteractor(&interactor_);
  handle.widget->SetRepresentation(handle.look);
  handle.widget->SetAnimationModeToJump();
  handle.widget->AddObserver(vtkCommand::InteractionEvent, this, &Sliders::note);
  handle.widget->AddObserver(vtkCommand::EndInteractionEvent, this, &Sliders::note);
  handle.widget->EnabledOn();
  return handle;
}

void Sliders::make_all(const DisplayedScene& scene) {
  column_.clear();
  seek_bar_.clear();
  const auto count = static_cast<double>(scene.sliders.size());
  const double step = std::min(kFarthestStep, (kTop - kBottom) / std::max(count, 1.0));
  double height = kTop;
  for (const auto& slider : scene.sliders) {
    column_.push_back(make(slider, kLeft, kRight, height));
    height -= step;
  }
  if (scene.seek_bar) {
    seek_bar_.push_back(make(*scene.seek_bar, kSeekLeft, kSeekRight, kSeekHeight));
  }
}

/// Those that are there stay as long as their number does: the mouse may hold one.
void Sliders::set(const DisplayedScene& scene) {
  const bool has_seek_bar = !seek_bar_.empty();
  if (scene.sliders.size() != column_.size() || scene.seek_bar.has_value() != has_seek_bar) {
    make_all(scene);
  }
  for (std::size_t i = 0; i < column_.size(); ++i) update(*column_[i].look, scene.sliders[i]);
  if (!scene.seek_bar) return;
  auto& look = *seek_bar_.front().look;
  look.SetMaximumValue(scene.seek_bar->upper);  // a recording may turn out to be shorter
  update(look, *scene.seek_bar);
}

void Sliders::note(vtkObject* widget, unsigned long /*event*/, void* /*data*/) {
  for (std::size_t i = 0; i < column_.size(); ++i) {
    if (column_[i].widget == widget) moves_.push_back({i, column_[i].look->GetValue()});
  }
  if (!seek_bar_.empty() && seek_bar_.front().widget == widget) {
    moves_.push_back({std::nullopt, seek_bar_.front().look->GetValue()});
  }
}

std::vector<SliderMove> Sliders::take_moves() {
  return std::exchange(moves_, {});
}

}  // namespace lockbox
