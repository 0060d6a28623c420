// SPDX-License-Identifier: BSD-3-Clause
#include "sliders.hpp"

#include <vtkCommand.h>
#include <vtkProperty2D.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "../src/letters.hpp"
#include "text_style.hpp"

namespace lockbox {
namespace {

// Of the window's width and height.
constexpr double kLeft = 0.02;
constexpr double kRight = 0.24;  // where letters are small beside the window
constexpr double kFarthestRight = 0.48;
constexpr double kTop = 0.88;
constexpr double kBottom = 0.1;
constexpr double kFarthestStep = 0.085;  // from one slider to the next
constexpr double kSeekLeft = 0.12;
constexpr double kSeekRight = 0.88;
constexpr double kSeekHeight = 0.06;
constexpr double kHandleHeight = 0.022;

// Pixels at scale 1.
constexpr double kColumn = 345.0;  // holds 42 letters of 13 pixels
constexpr double kLetters = 14.0;

constexpr double kLineHeight = 1.25;  // of the letters' size, with what hangs below the line

void style(vtkSliderRepresentation2D& look) {
  look.GetTubeProperty()->SetColor(0.45, 0.48, 0.55);
  look.GetSliderProperty()->SetColor(0.95, 0.7, 0.25);
  look.GetSelectedProperty()->SetColor(1.0, 0.85, 0.5);
  look.GetCapProperty()->SetColor(0.45, 0.48, 0.55);
  look.SetEndCapWidth(0.012);
  look.SetEndCapLength(0.004);
  look.SetTubeWidth(0.006);
  look.SetSliderWidth(kHandleHeight);
  look.SetSliderLength(0.012);
  look.ShowSliderLabelOff();
  look.GetPoint1Coordinate()->SetCoordinateSystemToNormalizedDisplay();
  look.GetPoint2Coordinate()->SetCoordinateSystemToNormalizedDisplay();
}

/// "latch  12.0 °  (0.0 to 90.0)"
std::string label_of(const SceneSlider& slider) {
  constexpr std::size_t kLongest = 32;
  char value[kLongest] = {};
  std::snprintf(value, kLongest, slider.format.c_str(), slider.value);
  std::string label = slider.name.empty() ? value : slider.name + "  " + value;
  if (!slider.limits.empty()) label += "  (" + slider.limits + ")";
  return label;
}

}  // namespace

Sliders::Handle Sliders::make(const SceneSlider& slider) {
  Handle handle{vtkSmartPointer<vtkSliderWidget>::New(),
                vtkSmartPointer<vtkSliderRepresentation2D>::New(),
                vtkSmartPointer<vtkTextActor>::New()};
  style(*handle.look);
  handle.look->SetMinimumValue(slider.lower);
  handle.look->SetMaximumValue(slider.upper);
  style(*handle.label->GetTextProperty(), scale_ * kLetters, 0.9);
  handle.label->GetTextProperty()->SetVerticalJustificationToTop();
  handle.label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  renderer_.AddViewProp(handle.label);
  handle.widget->SetInteractor(&interactor_);
  handle.widget->SetDefaultRenderer(&renderer_);
  handle.widget->SetRepresentation(handle.look);
  handle.widget->SetAnimationModeToJump();
  handle.widget->AddObserver(vtkCommand::InteractionEvent, this, &Sliders::note);
  handle.widget->AddObserver(vtkCommand::EndInteractionEvent, this, &Sliders::note);
  handle.widget->EnabledOn();
  return handle;
}

void Sliders::clear() {
  for (const auto* const handles : {&column_, &seek_bar_}) {
    for (const Handle& handle : *handles) renderer_.RemoveViewProp(handle.label);
  }
  column_.clear();
  seek_bar_.clear();
}

void Sliders::make_all(const DisplayedScene& scene) {
  clear();
  for (const auto& slider : scene.sliders) column_.push_back(make(slider));
  if (scene.seek_bar) seek_bar_.push_back(make(*scene.seek_bar));
}

/// As large as asked for where there is room for them.
double Sliders::letters_in(const Place& place, const SceneSlider& slider) const {
  const int* const window = renderer_.GetSize();  // pixels
  const auto count = static_cast<double>(count_letters(label_of(slider)));
  const double across =
      (place.right - place.left) * window[0] / (kLetterWidth * std::max(1.0, count));
  const double down = (place.room - kHandleHeight) * window[1] / kLineHeight;
  return std::max(1.0, std::min({scale_ * kLetters, across, down}));
}

void Sliders::update(const Handle& handle, const SceneSlider& slider, const Place& place,
                     double letters) {
  vtkSliderRepresentation2D& look = *handle.look;
  look.SetMinimumValue(slider.lower);
  look.SetMaximumValue(slider.upper);
  look.SetValue(std::clamp(slider.value, slider.lower, slider.upper));
  look.GetPoint1Coordinate()->SetValue(place.left, place.height);
  look.GetPoint2Coordinate()->SetValue(place.right, place.height);
  look.Modified();  // it does not notice that by itself
  handle.label->GetTextProperty()->SetFontSize(static_cast<int>(letters));
  handle.label->SetPosition(place.left, place.height - 0.75 * kHandleHeight);
  show(*handle.label, label_of(slider));
}

/// Those that are there stay as long as their number does: the mouse may hold one.
void Sliders::set(const DisplayedScene& scene) {
  const bool has_seek_bar = !seek_bar_.empty();
  if (scene.sliders.size() != column_.size() || scene.seek_bar.has_value() != has_seek_bar) {
    make_all(scene);
  }
  const double step = std::min(
      kFarthestStep, (kTop - kBottom) / std::max(1.0, static_cast<double>(column_.size())));
  const double right =
      std::clamp(kLeft + scale_ * kColumn / renderer_.GetSize()[0], kRight, kFarthestRight);
  double letters = scale_ * kLetters;  // the same of all
  for (const SceneSlider& slider : scene.sliders) {
    letters = std::min(letters, letters_in({kLeft, right, kTop, step}, slider));
  }
  for (std::size_t i = 0; i < column_.size(); ++i) {
    const double height = kTop - step * static_cast<double>(i);
    update(column_[i], scene.sliders[i], {kLeft, right, height, step}, letters);
  }
  // A recording may turn out to be shorter.
  if (scene.seek_bar) {
    const Place place{kSeekLeft, kSeekRight, kSeekHeight, kSeekHeight};
    update(seek_bar_.front(), *scene.seek_bar, place, letters_in(place, *scene.seek_bar));
  }
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
