// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "lockbox/terms/collision_term.hpp"

namespace lockbox {

/// Finds parts that stand within each other, and where they would not.
class OverlapFinder {
 public:
  OverlapFinder(const ArticulatedModel& model, const CollisionTerm& collision);

  /// Whether what the variable moves overlaps with the rest by more than contact and the noise of
  /// joints explain.
  bool overlaps(const Configuration& configuration, int variable);

  /// The configuration with that variable where in its range what it moves overlaps least with the
  /// rest, the nearest such position; unchanged if no position is much better.
  Configuration with_moved(const Configuration& configuration, int variable);

 private:
  double cost(const Configuration& configuration, const std::vector<std::uint8_t>& moved);

  const ArticulatedModel& model_;
  CollisionTerm collision_;  ///< of its own: it remembers where bodies were
  BodyPoses poses_;
};

}  // namespace lockbox
