// SPDX-License-Identifier: BSD-3-Clause
#include "captions.hpp"

#include <vtkCoordinate.h>
#include <vtkLookupTable.h>
#include <vtkTextProperty.h>

#include <algorithm>

#include "text_style.hpp"

namespace lockbox {
namespace {

// Pixels at scale 1.
constexpr double kStatusSize = 14.0;
constexpr double kSmallSize = 13.0;
constexpr double kLegendStep = 19.0;    // from line to line
constexpr double kLegendBottom = 0.09;  // of the height: above the seek bar
constexpr double kScaleRoom = 115.0;    // of the colour scale and its texts, up to the right margin
constexpr double kScaleWidth = 90.0;
constexpr std::size_t kMostLegendLines = 28;

constexpr int kDecades = 4;  // labels of a logarithmic scale, which goes over three of them
constexpr int kLinearLabels = 5;

void place(vtkTextActor& text, double x, double y) {
  text.GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text.SetPosition(x, y);
}

}  // namespace

Captions::Captions(vtkRenderer& renderer, double scale)
    : renderer_(renderer), scale_factor_(scale) {
  style(*status_->GetTextProperty(), scale * kStatusSize, 0.95);
  status_->GetTextProperty()->SetVerticalJustificationToTop();
  place(*status_, 0.012, 0.982);
  style(*help_->GetTextProperty(), scale * kSmallSize, 0.65);
  place(*help_, 0.012, 0.015);
  style(*scale_->GetTitleTextProperty(), scale * kSmallSize, 0.9);
  style(*scale_->GetLabelTextProperty(), scale * kSmallSize, 0.9);
  scale_->SetUnconstrainedFontSize(true);
  scale_->SetVerticalTitleSeparation(static_cast<int>(scale * kSmallSize / 2.0));
  scale_->SetHeight(0.4);
  scale_->VisibilityOff();
  for (vtkProp* prop : {static_cast<vtkProp*>(status_), static_cast<vtkProp*>(help_),
                        static_cast<vtkProp*>(scale_)}) {
    renderer.AddViewProp(prop);
  }
}

void Captions::set(const DisplayedScene& scene) {
  show(*status_, scene.status);
  show(*help_, scene.help);
  set_scale(scene);
  set_legend(scene.legend);
}

void Captions::add_legend_line() {
  LegendLine& line = legend_.emplace_back();
  for (vtkTextActor* const text : {line.patch.Get(), line.name.Get()}) {
    style(*text->GetTextProperty(), scale_factor_ * kSmallSize, 0.95);
    text->GetTextProperty()->SetVerticalJustificationToTop();
    renderer_.AddViewProp(text);
  }
}

void Captions::set_legend(const std::vector<LegendEntry>& legend) {
  const std::size_t lines = std::min(legend.size(), kMostLegendLines);
  std::size_t letters = 0;
  for (std::size_t i = 0; i < lines; ++i) letters = std::max(letters, legend[i].name.size());
  const int* const size = renderer_.GetSize();  // pixels
  const double letter = scale_factor_ * kSmallSize * kLetterWidth;
  const double margin = scale_factor_ * kSmallSize;
  const double name_at = size[0] - margin - letter * static_cast<double>(letters);
  while (legend_.size() < lines) add_legend_line();
  for (std::size_t i = 0; i < legend_.size(); ++i) {
    const auto& [patch, name] = legend_[i];
    show(*patch, i < lines ? "MM" : "");
    show(*name, i < lines ? legend[i].name : "");
    if (i >= lines) continue;
    const Eigen::Vector3d color = legend[i].color.cast<double>();
    patch->GetTextProperty()->SetColor(color.x(), color.y(), color.z());
    patch->GetTextProperty()->SetBackgroundColor(color.x(), color.y(), color.z());
    patch->GetTextProperty()->SetBackgroundOpacity(1.0);
    const double top =
        kLegendBottom * size[1] + scale_factor_ * kLegendStep * static_cast<double>(lines - i);
    patch->SetPosition(name_at - 3.0 * letter, top);
    name->SetPosition(name_at, top);
  }
}

void Captions::set_scale(const DisplayedScene& scene) {
  scale_->SetVisibility(scene.scale.empty() ? 0 : 1);
  if (scene.scale.empty()) return;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(static_cast<vtkIdType>(scene.scale.size()));
  if (scene.is_scale_logarithmic) table->SetScaleToLog10();
  table->SetTableRange(scene.scale.front().value, scene.scale.back().value);
  for (std::size_t i = 0; i < scene.scale.size(); ++i) {
    const Eigen::Vector3d color = scene.scale[i].color.cast<double>();
    table->SetTableValue(static_cast<vtkIdType>(i), color.x(), color.y(), color.z());
  }
  const double width = renderer_.GetSize()[0];
  scale_->SetPosition(1.0 - scale_factor_ * kScaleRoom / width, 0.3);
  scale_->SetWidth(scale_factor_ * kScaleWidth / width);
  scale_->SetLookupTable(table);
  scale_->SetNumberOfLabels(scene.is_scale_logarithmic ? kDecades : kLinearLabels);
  scale_->SetLabelFormat(scene.is_scale_logarithmic ? "%.2g" : "%+.0f");
  scale_->SetTitle(scene.scale_title.c_str());
}

}  // namespace lockbox
