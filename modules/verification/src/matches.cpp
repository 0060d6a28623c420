// SPDX-License-Identifier: BSD-3-Clause
#include "matches.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evidence_constants.hpp"

namespace lockbox {
namespace {

/// Positions that can be told apart, in nats.
double places_of(const Joint& joint) {
  const double step =
      joint.type == JointType::prismatic ? evidence::kPlaceLength : evidence::kPlaceAngle;
  const double range = std::min(joint.upper - joint.lower, 2.0 * std::numbers::pi);
  return std::log(std::max(1.0, range / step));
}

/// Of what a plane tells of a large object, so much it tells of one of so many cells: within a
/// smaller one there are fewer places where it could be.
double share_of_size(int cells) {
  const double across = std::sqrt(static_cast<double>(cells));
  const double all = std::log(evidence::kLargeObject / evidence::kLinePlace);
  return std::clamp(std::log(across / evidence::kLinePlace) / all, 0.0, 1.0);
}

}  // namespace

void Matches::add_to(Evidence& sum, const KinematicTree& tree, int planes) {
  of_plane_.assign(static_cast<std::size_t>(planes), 0.0);
  of_body_.assign(tree.bodies.size(), 0.0);
  for (const Told& cell : told_) {
    if (!(cell.nats > 0.0F)) continue;
    of_body_[static_cast<std::size_t>(cell.body)] += double{cell.nats};
    for (const int plane : {cell.planes.first, cell.planes.second}) {
      of_plane_[static_cast<std::size_t>(plane)] += double{cell.nats};
    }
  }
  double matched = 0.0;
  for (const double nats : of_plane_) matched += std::min(nats, evidence::kLine);
  const double share = share_of_size(sum.cells);
  sum.matched += share * matched;
  // Bodies come before those that they carry.
  for (std::size_t j = tree.joints.size(); j-- > 0;) {
    const Joint& joint = tree.joints[j];
    const double of_moved = of_body_[j + 1];
    if (!joint.is_mimic) sum.fitted -= std::min(share * of_moved, places_of(joint));
    of_body_[static_cast<std::size_t>(joint.parent_body)] += of_moved;
  }
}

}  // namespace lockbox
