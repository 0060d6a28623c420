// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lockbox/view/view_options.hpp"

namespace lockbox {

/// What the terms that compare the model with the image are weighed by (docs/mathematics.md).
struct TermOptions : ViewOptions {
  double visible_odds = 20.0;  ///< of the body predicted in a pixel against others as near
  double lambda_free = 3.0;    ///< the weight of free space; 0: it is not looked at
};

enum class CollisionMode { off, literal, eroded };

/// What bodies that penetrate each other are weighed by.
struct CollisionOptions {
  CollisionMode collision = CollisionMode::eroded;
  double lambda_collision = 1000.0;
  double collision_sigma = 1e-4;  ///< metres, whitens the penetration depth
  double erosion = 0.0015;        ///< metres, unless the model or a pair says otherwise
};

}  // namespace lockbox
