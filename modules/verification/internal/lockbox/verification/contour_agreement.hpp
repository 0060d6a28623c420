// SPDX-License-Identifier: BSD-3-Clause
// Whether the scene ends where the contour of a registered model does.
#pragma once

#include <array>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/verification/agreement.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// The contour of one body to one side: left, right, above or below.
struct ContourSide {
  ContourAgreement pixel_by_pixel;  ///< it goes on where what is beyond is as near as noise allows
  int measured = 0;                 ///< of its samples, on both sides of the contour
  double step = 0.0;  ///< the sum over these: farther beyond than within, standard deviations
};

/// Left, right, above and below.
using ContourSides = std::array<ContourSide, 4>;

/// Looks across the contour, if a sample of the surface in this pixel of the view lies at one.
void look_beyond(const VisibleSurface& surface, const Pixel& sample, const TiledCloud& cloud,
                 const ViewOptions& options, ContourSides& sides);

void add(const ContourSides& sides, ContourSides& sums);

/// Adds the sides of one body.
void add(const ContourSides& sides, ContourAgreement& contour);

}  // namespace lockbox
