// SPDX-License-Identifier: BSD-3-Clause
// Which flat sides of a model can be told in a view, and are worth to be looked for.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "flat_sides.hpp"
#include "lockbox/model/kinematic_tree.hpp"

namespace lockbox {

struct ModelSide {
  int body;
  FlatSide flat;           ///< in the body's frame
  Eigen::Vector3d normal;  ///< in the base's, at rest
};

/// Returns the sides that can be told in a view, by body.
std::vector<ModelSide> flat_sides(const KinematicTree& tree);

/// How much of a side may be seen.
struct Facing {
  Eigen::Vector3d normal;  ///< in the base's frame, at rest
  double area;             ///< square metres
};

/// Above all among those that face the same way: from the front only fronts are seen, however large
/// the other sides are.
bool is_large(const Facing& side, const std::vector<Facing>& sides);

/// The share of the surface that lies in flat sides, 0 to 1.
double flat_share(const KinematicTree& tree);

}  // namespace lockbox
