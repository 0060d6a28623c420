// SPDX-License-Identifier: BSD-3-Clause
// What the model term keeps of a few tiles of points.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "lockbox/kernels/point_to_field.hpp"
#include "lockbox/solver/normal_equations.hpp"
#include "lockbox/terms/oriented_box.hpp"

namespace lockbox {

/// A body at a pose, as candidates are sought and points looked up.
struct PosedBody {
  bool has_field;
  kernels::RigidMotion from_camera;
  Eigen::Isometry3d T_body_camera;
  OrientedBox box;
};

struct ModelTermTotals {
  double weighted_squares = 0.0;  ///< sum of weight * whitened residual^2
  double points = 0.0;            ///< sum of weights: points that the model explains
};

/// Consecutive tiles of the points, and the bodies that compete for their points.
struct ModelTermChunk {
  static constexpr std::size_t kTiles = 8;         // fixed, so that sums do not depend on threads
  static constexpr std::size_t kPlaneNumbers = 4;  // of a plane: its offset and its normal

  std::array<std::size_t, kTiles + 1> first{};   ///< candidate of each tile
  std::vector<int> bodies;                       ///< by candidate, tile by tile
  std::vector<float> body_numbers;               ///< the same, as the kernels compare them
  std::vector<float> inverse_variance;           ///< kTilePoints a candidate
  std::vector<TileSystem> tile_systems;          ///< by candidate
  std::vector<std::pair<int, BodySystem>> sums;  ///< of the bodies that occur
  std::array<bool, kTiles> has_planes{};
  std::unique_ptr<float[]> planes;  ///< kPlaneNumbers arrays of kTilePoints a tile
  double annealing_sigma = 0.0;     ///< metres
  double cost = 0.0;
  ModelTermTotals totals;
};

}  // namespace lockbox
