// SPDX-License-Identifier: BSD-3-Clause
// What is needed to propose poses by pairs of points: those of one body, and a scene without what
// cannot be the model.
#pragma once

#include <cstddef>
#include <vector>

#include "lockbox/verification/coarse_view.hpp"
#include "planar_regions.hpp"
#include "point_pairs.hpp"

namespace lockbox {

/// The body that is sought, and its pairs.
struct BodyPairs {
  std::size_t body;
  PointPairs pairs;
};

/// The bodies that may be found by themselves: that with the largest surface first, and those that
/// have no much smaller one.
std::vector<std::size_t> telling_bodies(const KinematicTree& tree);

BodyPairs make_body_pairs(const KinematicTree& tree, std::size_t body, const Executor& executor);

/// The depths of the view without the planes of the scene that reach farther than the model could:
/// walls, tables. diameter: of the model, metres. The planes may be of a coarser view.
std::vector<float> without_wide_planes(const CoarseView& view, const PlanarScene& scene,
                                       double diameter);

}  // namespace lockbox
