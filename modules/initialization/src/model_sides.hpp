// SPDX-License-Identifier: BSD-3-Clause
// Which flat sides of a model can be told in a view, and are worth to be looked for.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "flat_sides.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

/// Of a model at rest.
struct Facing {
  Eigen::Vector3d normal;  ///< in the base's frame
  double area;             ///< square metres
};

/// Among those that face the same way: from the front only fronts are seen, however large the other
/// sides are.
bool is_large(const Facing& side, const std::vector<Facing>& sides);

struct ModelSide {
  int body;
  FlatSide flat;  ///< in the body's frame
};

/// By body.
std::vector<ModelSide> large_sides(const KinematicTree& tree);

/// The share of the surface that lies in flat sides, 0 to 1.
double flat_share(const KinematicTree& tree);

}  // namespace lockbox
