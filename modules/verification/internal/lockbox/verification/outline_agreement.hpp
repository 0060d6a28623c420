// SPDX-License-Identifier: BSD-3-Clause
// Whether the scene ends where the outline of a registered model does.
#pragma once

#include <array>

#include "lockbox/cloud/tiled_cloud.hpp"
#include "lockbox/verification/agreement.hpp"
#include "lockbox/view/view_options.hpp"
#include "lockbox/view/visible_surface.hpp"

namespace lockbox {

/// The outline of one body to one side: left, right, above or below.
struct OutlineSide {
  OutlineAgreement pixel_by_pixel;  ///< it goes on where what is beyond is as near as noise allows
  int measured = 0;                 ///< of its samples, on both sides of the outline
  double step = 0.0;  ///< the sum over these: farther beyond than within, standard deviations
};

/// Left, right, above and below.
using OutlineSides = std::array<OutlineSide, 4>;

/// Looks across the outline, if a sample of the surface in this pixel of the view lies at one.
void look_beyond(const VisibleSurface& surface, const Pixel& sample, const TiledCloud& cloud,
                 const ViewOptions& options, OutlineSides& sides);

void add(const OutlineSides& sides, OutlineSides& sums);

/// Of one body.
void add(const OutlineSides& sides, OutlineAgreement& outline);

}  // namespace lockbox
