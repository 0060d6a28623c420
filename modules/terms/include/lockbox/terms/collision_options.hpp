// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

enum class CollisionMode { off, literal, eroded };

struct CollisionOptions {
  CollisionMode collision = CollisionMode::eroded;
  double lambda_collision = 1000.0;
  double collision_sigma = 1e-4;  ///< metres, whitens the penetration depth
  double erosion = 0.0015;        ///< metres, unless the model or a pair says otherwise
};

}  // namespace lockbox
