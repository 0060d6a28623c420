// SPDX-License-Identifier: BSD-3-Clause
// Texts over pictures: VTK draws letters without OpenGL, and so without a display.
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "component.hpp"
#include "text_style.hpp"

namespace lockbox {
namespace {

constexpr double kGrey = 0.95;
constexpr int kDotsPerInch = 72;  // a point is a pixel

/// letters: red, green, blue and cover of each pixel, from the text's upper left corner, y up.
void lay_over(vtkImageData& letters, const int* size, const PlacedText& text, RgbImage& picture) {
  const int* const extent = letters.GetExtent();
  for (int y = 0; y < size[1]; ++y) {
    const int v = text.v - (extent[2] + y);
    if (v < 0 || v >= picture.height) continue;
    for (int x = 0; x < size[0]; ++x) {
      const int u = text.u + extent[0] + x;
      if (u < 0 || u >= picture.width) continue;
      const auto* const letter = static_cast<const std::uint8_t*>(
          letters.GetScalarPointer(extent[0] + x, extent[2] + y, 0));
      const double cover = letter[3] / 255.0;
      auto pixel =
          picture.rgb.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{v} * picture.width + u);
      for (int channel = 0; channel < 3; ++channel, ++pixel) {
        *pixel = static_cast<std::uint8_t>(
            std::lround(cover * letter[channel] + (1.0 - cover) * *pixel));
      }
    }
  }
}

}  // namespace
}  // namespace lockbox

extern "C" {

__attribute__((visibility("default"))) bool lockbox_write_texts(
    const std::vector<lockbox::PlacedText>& texts, int letters, lockbox::RgbImage& picture,
    std::string& problem) try {
  vtkTextRenderer* const renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr) throw std::runtime_error("VTK has no fonts");
  vtkNew<vtkTextProperty> look;
  lockbox::style(*look, letters, lockbox::kGrey);
  look->SetBackgroundOpacity(0.0);
  look->SetVerticalJustificationToTop();
  for (const lockbox::PlacedText& text : texts) {
    if (text.text.empty()) continue;
    vtkNew<vtkImageData> image;
    int size[2] = {};
    if (!renderer->RenderString(look, vtkStdString(text.text), image, size,
                                lockbox::kDotsPerInch)) {
      throw std::runtime_error("VTK cannot draw '" + text.text + "'");
    }
    lockbox::lay_over(*image, size, text, picture);
  }
  return true;
} catch (const std::exception& error) {
  problem = error.what();
  return false;
}
}
