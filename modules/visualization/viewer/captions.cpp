// SPDX-License-Identifier: BSD-3-Clause
#include "captions.hpp"

#include <vtkCoordinate.h>
#include <vtkLookupTable.h>
#include <vtkTextProperty.h>

namespace lockbox {
namespace {

constexpr int kStatusSize = 14;  // pixels
constexpr int kSmallSize = 13;
constexpr int kOverlaySize = 16;

void place(vtkTextActor& text, double x, double y) {
  text.GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text.SetPosition(x, y);
}

void style(vtkTextProperty& look, int size, double grey) {
  look.SetFontFamilyToCourier();
  look.SetFontSize(size);
  look.SetColor(grey, grey, grey);
  look.ItalicOff();
  look.BoldOff();
  look.ShadowOff();
  look.SetBackgroundColor(0.05, 0.06, 0.08);
  look.SetBackgroundOpacity(0.5);  // readable over bright points
}

void show(vtkTextActor& text, const std::string& lines) {
  text.SetInput(lines.c_str());
  text.SetVisibility(lines.empty() ? 0 : 1);
}

}  // namespace

Captions::Captions(vtkRenderer& renderer) {
  style(*status_->GetTextProperty(), kStatusSize, 0.95);
  status_->GetTextProperty()->SetVerticalJustificationToTop();
  place(*status_, 0.012, 0.982);
  style(*help_->GetTextProperty(), kSmallSize, 0.65);
  place(*help_, 0.012, 0.015);
  style(*overlay_->GetTextProperty(), kOverlaySize, 0.95);
  overlay_->GetTextProperty()->SetBackgroundOpacity(0.85);
  overlay_->GetTextProperty()->SetVerticalJustificationToCentered();
  overlay_->GetTextProperty()->SetFrame(true);
  overlay_->GetTextProperty()->SetFrameColor(0.5, 0.5, 0.5);
  place(*overlay_, 0.3, 0.5);
  style(*scale_->GetTitleTextProperty(), kSmallSize, 0.9);
  style(*scale_->GetLabelTextProperty(), kSmallSize, 0.9);
  scale_->SetUnconstrainedFontSize(true);
  scale_->SetLabelFormat("%+.0f");
  scale_->SetVerticalTitleSeparation(kSmallSize / 2);
  scale_->SetPosition(0.91, 0.3);
  scale_->SetWidth(0.07);
  scale_->SetHeight(0.4);
  scale_->VisibilityOff();
  for (vtkProp* prop : {static_cast<vtkProp*>(status_), static_cast<vtkProp*>(help_),
                        static_cast<vtkProp*>(overlay_), static_cast<vtkProp*>(scale_)}) {
    renderer.AddViewProp(prop);
  }
}

void Captions::set(const DisplayedScene& scene) {
  show(*status_, scene.status);
  show(*help_, scene.help);
  show(*overlay_, scene.overlay);
  set_scale(scene);
}

void Captions::set_scale(const DisplayedScene& scene) {
  scale_->SetVisibility(scene.scale.empty() ? 0 : 1);
  if (scene.scale.empty()) return;
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(static_cast<vtkIdType>(scene.scale.size()));
  table->SetTableRange(scene.scale.front().value, scene.scale.back().value);
  for (std::size_t i = 0; i < scene.scale.size(); ++i) {
    const Eigen::Vector3d color = scene.scale[i].color.cast<double>();
    table->SetTableValue(static_cast<vtkIdType>(i), color.x(), color.y(), color.z());
  }
  scale_->SetLookupTable(table);
  scale_->SetTitle(scene.scale_title.c_str());
}

}  // namespace lockbox
